#pragma once

#include "common/random.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::material {

/// Uniform on SO(3) (Shoemake 1992) from three uniform numbers of counter `index`.
Eigen::Quaterniond uniform_rotation(const RandomStream& random, std::uint64_t index);

/// `count` orientations whose mean of the cubic axes' fourth-order moment is as near to
/// that of a random polycrystal as a search finds; the same on each call.
std::vector<Eigen::Quaterniond> isotropic_set(std::size_t count);

/// Orientations of `per_point` grains for each of `points` points, point by point. Each
/// point has the same isotropic set under a uniform rotation of its own: less scatter
/// than independent grains, and no texture common to all points.
std::vector<Eigen::Quaterniond> grain_orientations(std::size_t points,
                                                   std::size_t per_point,
                                                   std::uint64_t seed);

}  // namespace taylorcal::material
