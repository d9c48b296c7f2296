#pragma once

#include "common/random.hpp"

#include <array>
#include <cstdint>

#include <Eigen/Geometry>

namespace taylorcal::material {

/// Uniform on SO(3) (Shoemake 1992) if the three numbers in [0, 1) are.
Eigen::Quaterniond rotation_of(const std::array<double, 3>& uniform);

/// That of three uniform numbers of counter `index`.
Eigen::Quaterniond uniform_rotation(const RandomStream& random, std::uint64_t index);

}  // namespace taylorcal::material
