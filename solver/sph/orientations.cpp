#include "solver/sph/orientations.hpp"

#include "common/random.hpp"

#include <cmath>
#include <numbers>

namespace taylorcal::sph {

std::vector<Eigen::Quaterniond> random_orientations(std::uint64_t seed,
                                                    std::size_t count) {
    constexpr std::uint64_t stream = 3;
    const RandomStream random(seed, stream);
    std::vector<Eigen::Quaterniond> orientations(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto words = random.words(i);
        const auto uniform = [&](std::size_t w) {
            return (words[w] + 0.5) / 4294967296.0;
        };
        const double a = std::sqrt(1 - uniform(0)), b = std::sqrt(uniform(0));
        const double p = 2 * std::numbers::pi * uniform(1);
        const double q = 2 * std::numbers::pi * uniform(2);
        orientations[i] = Eigen::Quaterniond(b * std::cos(q), a * std::sin(p),
                                             a * std::cos(p), b * std::sin(q));
    }
    return orientations;
}

}  // namespace taylorcal::sph
