#include "calibrate/prior_pass/unit_sequence.hpp"

#include "common/errors.hpp"
#include "common/random.hpp"

namespace taylorcal::calibrate {
namespace {

constexpr std::size_t bits = 32;
using Directions = std::array<std::uint32_t, bits>;

/// Streams of Philox that no pass of `DrawNumbers` uses.
constexpr std::uint64_t draw_stream = std::uint64_t{1} << 62U;
constexpr std::uint64_t scramble_stream = draw_stream + 1;

std::uint32_t reversed(std::uint32_t x) {
    x = x << 16U | x >> 16U;
    x = (x & 0x00ff00ffU) << 8U | (x & 0xff00ff00U) >> 8U;
    x = (x & 0x0f0f0f0fU) << 4U | (x & 0xf0f0f0f0U) >> 4U;
    x = (x & 0x33333333U) << 2U | (x & 0xccccccccU) >> 2U;
    return (x & 0x55555555U) << 1U | (x & 0xaaaaaaaaU) >> 1U;
}

/// Direction numbers, bit-reversed, by the recurrence of a primitive polynomial of
/// `degree` with inner coefficients `inner`.
Directions directions(unsigned degree, unsigned inner, std::vector<std::uint32_t> m) {
    Directions v{};
    for (unsigned k = 0; k < bits; ++k) {
        if (degree == 0) {
            v[k] = 1U << (bits - 1 - k);
        } else if (k < degree) {
            v[k] = m[k] << (bits - 1 - k);
        } else {
            v[k] = v[k - degree] ^ (v[k - degree] >> degree);
            for (unsigned j = 1; j < degree; ++j)
                if ((inner >> (degree - 1 - j) & 1U) != 0) v[k] ^= v[k - j];
        }
    }
    for (std::uint32_t& direction : v) direction = reversed(direction);
    return v;
}

const std::array<Directions, UnitSequence::most_dimensions>& all_directions() {
    static const std::array<Directions, UnitSequence::most_dimensions> all{
        directions(0, 0, {}), directions(1, 0, {1}), directions(2, 1, {1, 3}),
        directions(3, 1, {1, 3, 1})};
    return all;
}

/// Owen's scrambling of a bit-reversed number: each bit is flipped by a hash of those
/// above it (below it, reversed).
std::uint32_t scrambled(std::uint32_t x, std::uint32_t key) {
    x += key;
    x ^= x * 0x6c50b47cU;
    x ^= x * 0xb82f1e52U;
    x ^= x * 0xc7afe638U;
    x ^= x * 0x8d22f6e6U;
    return x;
}

}  // namespace

UnitSequence::UnitSequence(DrawSequence kind, std::uint64_t seed, std::size_t dimensions)
    : kind_(kind), seed_(seed), dimensions_(dimensions) {
    if (dimensions > most_dimensions)
        throw NumericalError("plain draws have at most four dimensions");
}

void UnitSequence::fill(
    std::uint64_t number_of_block, std::size_t count,
    std::array<std::vector<std::uint32_t>, most_dimensions>& words) const {
    for (std::size_t d = 0; d < dimensions_; ++d) words[d].resize(count);
    if (kind_ == DrawSequence::sobol) return fill_sobol(number_of_block, count, words);
    const RandomStream random(seed_, draw_stream);
    for (std::size_t i = 0; i < count; ++i) {
        const Words draw = random.words(number_of_block * block + i);
        for (std::size_t d = 0; d < dimensions_; ++d) words[d][i] = draw[d];
    }
}

void UnitSequence::fill_sobol(
    std::uint64_t number_of_block, std::size_t count,
    std::array<std::vector<std::uint32_t>, most_dimensions>& words) const {
    const std::uint64_t position = number_of_block / replicates * block;
    const auto first = static_cast<std::uint32_t>(position);
    const std::uint64_t scrambling =
        (position >> bits) * replicates + replicate_of(number_of_block);
    const Words keys = RandomStream(seed_, scramble_stream).words(scrambling);
    for (std::size_t d = 0; d < dimensions_; ++d) {
        const Directions& v = all_directions()[d];
        std::vector<std::uint32_t>& out = words[d];
        std::uint32_t start = 0;
        for (unsigned k = 0; k < bits; ++k)
            if ((first >> k & 1U) != 0) start ^= v[k];
        // Within a block the sequence is linear in the low bits: each doubling adds one.
        out[0] = start;
        for (std::size_t done = 1, k = 0; done < count; done *= 2, ++k)
            for (std::size_t i = done; i < std::min(2 * done, count); ++i)
                out[i] = out[i - done] ^ v[k];
        for (std::uint32_t& word : out) word = reversed(scrambled(word, keys[d]));
    }
}

}  // namespace taylorcal::calibrate
