#include "common/sha256.hpp"

#include "common/atomic_file.hpp"

#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <openssl/evp.h>

namespace taylorcal {

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(),
                   nullptr) != 1)
        throw std::runtime_error("OpenSSL gives no SHA-256. Is its installation whole?");
    return fmt::format("{:02x}", fmt::join(digest.data(), digest.data() + size, ""));
}

std::string sha256_of_file(const std::filesystem::path& path) {
    return sha256(read_text(path));
}

}  // namespace taylorcal
