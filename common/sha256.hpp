#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace taylorcal {

/// SHA-256 of `bytes` as 64 hexadecimal digits: what `sha256sum` prints. Made by OpenSSL.
std::string sha256(std::string_view bytes);

/// The same of a file's bytes. InputError when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace taylorcal
