#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::material {

/// Turns a grain that was drawn at random into that of a texture, with the help of a
/// number uniform in [0, 1); must commute with turns about z.
using OrientationChange =
    std::function<Eigen::Quaterniond(const Eigen::Quaterniond& drawn, double uniform)>;

/// A grain after all changes. Its uniform numbers are a function of `seed`, of the
/// `point` and of the grain's number among the point's `per_point`, over which they are
/// spread evenly: a share of all grains is one of each point's.
Eigen::Quaterniond changed_orientation(const std::vector<OrientationChange>& changes,
                                       const Eigen::Quaterniond& drawn,
                                       std::uint64_t seed, std::uint64_t point,
                                       std::size_t grain, std::size_t per_point);

/// Orientations of `per_point` grains for each of `points` points, point by point. Each
/// point has the same isotropic set under a rotation of its own, and the rotations of
/// points that follow each other cover all of them evenly: less scatter than
/// independent grains, and no texture common to all points.
std::vector<Eigen::Quaterniond> grain_orientations(
    std::size_t points, std::size_t per_point, std::uint64_t seed,
    const std::vector<OrientationChange>& changes = {});

}  // namespace taylorcal::material
