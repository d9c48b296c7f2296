#include "common/random.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using taylorcal::RandomStream;

// Known answers published with the generator (Random123, kat_vectors, "philox4x32 10").
TEST_CASE("Philox4x32-10 gives its published answers", "[random]") {
    using Words = std::array<std::uint32_t, 4>;
    CHECK(RandomStream(0, 0).words(0) ==
          Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    const std::uint64_t ones = ~std::uint64_t{0};
    CHECK(RandomStream(ones, ones).words(ones) ==
          Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    // Digits of pi: counter 243f6a88 85a308d3 13198a2e 03707344, key a4093822 299f31d0.
    CHECK(
        RandomStream(0x299f31d0a4093822, 0x0370734413198a2e).words(0x85a308d3243f6a88) ==
        Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("uniform numbers have the moments of their law", "[random]") {
    const RandomStream stream(7, 3);
    constexpr int n = 200000;
    double sum = 0, squares = 0, smallest = 1, largest = 0;
    for (int i = 0; i < n; ++i) {
        const double value = stream.uniform(static_cast<std::uint64_t>(i));
        sum += value;
        squares += value * value;
        smallest = std::min(smallest, value);
        largest = std::max(largest, value);
    }
    // Five standard errors of the mean of u and of u^2.
    CHECK(std::abs(sum / n - 0.5) < 5 * std::sqrt(1.0 / 12 / n));
    CHECK(std::abs(squares / n - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / n));
    CHECK(smallest > 0);
    CHECK(largest < 1);
}

TEST_CASE("normal numbers have the moments of their law", "[random]") {
    const RandomStream stream(11, 5);
    constexpr int n = 200000;
    double moment[5] = {};
    for (int i = 0; i < n; ++i) {
        const double value = stream.normal(static_cast<std::uint64_t>(i));
        double power = 1;
        for (double& m : moment) {
            m += power / n;
            power *= value;
        }
    }
    // Five standard errors; the variances of x^k are 1, 2, 15 and 96.
    CHECK(std::abs(moment[1]) < 5 * std::sqrt(1.0 / n));
    CHECK(std::abs(moment[2] - 1) < 5 * std::sqrt(2.0 / n));
    CHECK(std::abs(moment[3]) < 5 * std::sqrt(15.0 / n));
    CHECK(std::abs(moment[4] - 3) < 5 * std::sqrt(96.0 / n));
}

TEST_CASE("streams and seeds are independent", "[random]") {
    constexpr int n = 100000;
    double by_stream = 0, by_seed = 0, by_index = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const double value = RandomStream(1, 1).normal(i);
        by_stream += value * RandomStream(1, 2).normal(i) / n;
        by_seed += value * RandomStream(2, 1).normal(i) / n;
        by_index += value * RandomStream(1, 1).normal(i + 1) / n;
    }
    const double bound = 5 / std::sqrt(n);
    CHECK(std::abs(by_stream) < bound);
    CHECK(std::abs(by_seed) < bound);
    CHECK(std::abs(by_index) < bound);
}
