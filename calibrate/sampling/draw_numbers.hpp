#pragma once

#include "common/random.hpp"

#include <cstdint>
#include <vector>

namespace taylorcal::calibrate {

/// The random numbers of one pass: each a pure function of (seed, pass, purpose, draw).
class DrawNumbers {
  public:
    enum class Purpose : std::uint64_t { shared, own, order, choice, priority, start };

    DrawNumbers(std::uint64_t seed, std::uint64_t pass) : seed_(seed), pass_(pass) {}

    /// Uniform in (0, 1); `lane` tells lots and `dimension` coordinates apart.
    double operator()(Purpose purpose, std::uint64_t index, std::uint64_t lane = 0,
                      std::uint64_t dimension = 0) const {
        const std::uint64_t stream =
            (((pass_ * 8 + static_cast<std::uint64_t>(purpose)) << 24 | lane) << 16) |
            dimension;
        return RandomStream(seed_, stream).uniform(index);
    }
    /// A permutation of 0 .. count-1 for one draw (Fisher-Yates).
    std::vector<std::size_t> permutation(std::size_t count, std::uint64_t draw,
                                         std::uint64_t lane,
                                         std::uint64_t dimension) const {
        std::vector<std::size_t> order(count);
        for (std::size_t i = 0; i < count; ++i) order[i] = i;
        for (std::size_t i = count; i-- > 1;) {
            const double u = (*this)(Purpose::order, draw * count + i, lane, dimension);
            std::swap(order[i],
                      order[static_cast<std::size_t>(u * static_cast<double>(i + 1))]);
        }
        return order;
    }

  private:
    std::uint64_t seed_;
    std::uint64_t pass_;
};

}  // namespace taylorcal::calibrate
