#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::sph {

/// `count` lattice orientations, uniform over all rotations (Shoemake 1992) and a pure
/// function of the seed.
std::vector<Eigen::Quaterniond> random_orientations(std::uint64_t seed,
                                                    std::size_t count);

}  // namespace taylorcal::sph
