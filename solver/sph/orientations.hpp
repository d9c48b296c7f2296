#pragma once

#include "solver/material/grain_orientations.hpp"
#include "solver/sph/packing.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::sph {

/// Lattice orientations of `grains` grains for every slot of the active blocks, in the
/// order of the strength's blocks: for each active block its first grains, its second ...
///
/// A particle's grains are an isotropic set under a uniform rotation of its own, a pure
/// function of the seed, but particles that a quarter turn about the axis carries onto
/// each other have orientations that it carries onto each other too. A particle stands
/// for ten thousand grains; left independent, its single one would be enough to bend a
/// slender head to a side.
std::vector<Eigen::Quaterniond> random_orientations(
    std::uint64_t seed, const Packing& packing, std::size_t grains,
    const std::vector<material::OrientationChange>& changes = {});

}  // namespace taylorcal::sph
