#pragma once

#include "common/lanes.hpp"
#include "solver/material/slip_systems.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace taylorcal::material {

/// One number a grain of a block.
using LaneValues = std::array<double, lane_count<float>>;

/// A block of grains as those see it who change the dislocation model, SI units. Entries
/// from `lanes` on mean nothing; some of the first may be padding.
struct GrainBlock {
    std::size_t lanes = 0;                       ///< entries in use
    LaneValues temperature{};                    ///< [K]
    LaneValues shear_modulus{};                  ///< G [Pa]
    LaneValues annihilated_energy{};             ///< J [J/m3]
    std::array<LaneValues, 5> plastic_strain{};  ///< w, deviator in the crystal frame
    std::array<LaneValues, slip_system_count> mobile{};      ///< rhoD by system [1/m2]
    std::array<LaneValues, slip_system_count> immobile{};    ///< rhoI by system [1/m2]
    std::array<LaneValues, slip_system_count> slip_speed{};  ///< |V| of the substep [m/s]
    double duration = 0;                                     ///< of the substep [s]
    LaneValues slip_resistance{};                            ///< Ys [Pa]
    std::array<LaneValues, 5> back_stress{};  ///< deviator in the crystal frame [Pa]
};
using GrainHook = std::function<void(GrainBlock&)>;

/// What is called while grains deform. Densities and strains are those at the start of
/// the substep, unless said otherwise.
struct GrainHooks {
    /// Change `slip_resistance`, which comes as Eq. 20 has it; also before a substep that
    /// may be elastic. `slip_speed` and `duration` are zero.
    std::vector<GrainHook> slip_resistance;
    /// Add to `back_stress`, which is taken from the stress that drives slip.
    std::vector<GrainHook> back_stress;
    /// Change `mobile` and `immobile` after a substep in which some grain slipped, given
    /// the densities that Eqs. 15-19 lead to.
    std::vector<GrainHook> densities;
};

/// The hooks, and by what factor each grain's rhoI(0) differs (empty: none does).
struct GrainChanges {
    GrainHooks hooks;
    std::vector<double> immobile_factor;
};

}  // namespace taylorcal::material
