#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace taylorcal {

/// Writes a file so that a reader sees all of it or nothing: `write` fills a temporary
/// name beside `path`, which is flushed to the disk and renamed. InputError if the folder
/// cannot be written. The temporary file is removed when `write` throws.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text.
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

/// The last step alone, for a writer that keeps its temporary file open: flushes
/// `finished` to the disk and gives it its final name.
void rename_atomically(const std::filesystem::path& finished,
                       const std::filesystem::path& path);

/// The whole of a text file. InputError if it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace taylorcal
