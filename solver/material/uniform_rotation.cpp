#include "solver/material/uniform_rotation.hpp"

#include <cmath>
#include <numbers>

namespace taylorcal::material {

Eigen::Quaterniond rotation_of(const std::array<double, 3>& uniform) {
    const double u = uniform[0];
    const double first = 2 * std::numbers::pi * uniform[1];
    const double second = 2 * std::numbers::pi * uniform[2];
    return {std::sqrt(u) * std::cos(second), std::sqrt(1 - u) * std::sin(first),
            std::sqrt(1 - u) * std::cos(first), std::sqrt(u) * std::sin(second)};
}

Eigen::Quaterniond uniform_rotation(const RandomStream& random, std::uint64_t index) {
    return rotation_of({random.uniform(3 * index), random.uniform(3 * index + 1),
                        random.uniform(3 * index + 2)});
}

}  // namespace taylorcal::material
