#pragma once

#include <array>
#include <cstdint>

namespace taylorcal {

/// Counter-based random numbers (Philox4x32-10, Salmon et al. 2011,
/// doi 10.1145/2063384.2063405): a pure function of (seed, stream, index), so that
/// results do not depend on the order or the number of threads in which they are asked
/// for.
class RandomStream {
  public:
    RandomStream(std::uint64_t seed, std::uint64_t stream)
        : seed_(seed), stream_(stream) {}

    /// Four independent 32-bit words of counter `index`.
    std::array<std::uint32_t, 4> words(std::uint64_t index) const;
    /// Uniform in the open interval (0, 1), 53 bits.
    double uniform(std::uint64_t index) const;
    /// Standard normal (Box-Muller on one counter).
    double normal(std::uint64_t index) const;

  private:
    std::uint64_t seed_;
    std::uint64_t stream_;
};

}  // namespace taylorcal
