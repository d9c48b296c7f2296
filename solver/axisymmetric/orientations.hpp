#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::axisymmetric {

/// Orientations of `per_point` grains for each of `points` points, point by point. Each
/// point has the same near-isotropic set (its mean of the cubic axes' fourth-order moment
/// is as near to that of a random polycrystal as a search finds) under a rotation of its
/// own, uniform on SO(3) by counter-based random numbers: less scatter than independent
/// grains, and no texture common to all points.
std::vector<Eigen::Quaterniond> grain_orientations(std::size_t points,
                                                   std::size_t per_point,
                                                   std::uint64_t seed);

}  // namespace taylorcal::axisymmetric
