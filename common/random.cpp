#include "common/random.hpp"

#include <cmath>
#include <numbers>

namespace taylorcal {

namespace {

using Words = std::array<std::uint32_t, 4>;

std::uint32_t low(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
std::uint32_t high(std::uint64_t value) {
    return static_cast<std::uint32_t>(value >> 32);
}

/// One round of Philox4x32 (Salmon et al. 2011, section 3.3).
Words philox_round(const Words& counter, std::uint32_t key_0, std::uint32_t key_1) {
    constexpr std::uint64_t multiplier_0 = 0xD2511F53;
    constexpr std::uint64_t multiplier_1 = 0xCD9E8D57;
    const std::uint64_t product_0 = multiplier_0 * counter[0];
    const std::uint64_t product_1 = multiplier_1 * counter[2];
    return {high(product_1) ^ counter[1] ^ key_0, low(product_1),
            high(product_0) ^ counter[3] ^ key_1, low(product_0)};
}

/// Two words to an odd multiple of 2^-53, which is neither 0 nor 1 and has mean 1/2.
double open_unit_interval(std::uint32_t first, std::uint32_t second) {
    const std::uint64_t bits = (std::uint64_t{first >> 5} << 26) | (second >> 6);
    return static_cast<double>(bits | 1) * 0x1p-53;
}

}  // namespace

std::array<std::uint32_t, 4> RandomStream::words(std::uint64_t index) const {
    constexpr int rounds = 10;
    constexpr std::uint32_t weyl_0 = 0x9E3779B9;
    constexpr std::uint32_t weyl_1 = 0xBB67AE85;
    Words counter = {low(index), high(index), low(stream_), high(stream_)};
    std::uint32_t key_0 = low(seed_);
    std::uint32_t key_1 = high(seed_);
    for (int round = 0; round < rounds; ++round) {
        counter = philox_round(counter, key_0, key_1);
        key_0 += weyl_0;
        key_1 += weyl_1;
    }
    return counter;
}

double RandomStream::uniform(std::uint64_t index) const {
    const Words word = words(index);
    return open_unit_interval(word[0], word[1]);
}

double RandomStream::normal(std::uint64_t index) const {
    const Words word = words(index);
    const double radius = std::sqrt(-2 * std::log(open_unit_interval(word[0], word[1])));
    return radius * std::cos(2 * std::numbers::pi * open_unit_interval(word[2], word[3]));
}

}  // namespace taylorcal
