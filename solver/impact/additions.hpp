#pragma once

#include "solver/material/grain_hooks.hpp"
#include "solver/material/grain_orientations.hpp"

#include <functional>
#include <vector>

namespace taylorcal::impact {

/// What a run has beyond the model of its parameters. As it stands it adds nothing: a
/// rigid and smooth anvil, random grains, homogeneous metal.
struct Additions {
    material::GrainHooks grains;
    std::vector<material::OrientationChange> orientations;
    /// Factors of rhoI(0) at a radius and a height in the undeformed specimen [m].
    std::vector<std::function<double(double radius, double height)>> initial_density;
    double unheated_share = 0;  ///< of the plastic work, taken from `taylor_quinney`
    double friction_coefficient = 0;  ///< Coulomb's, at the anvil
    double anvil_compliance = 0;      ///< velocity of its face over pressure [m/s/Pa]
    double anvil_tilt = 0;            ///< of its normal towards x, against the axis [rad]
};

}  // namespace taylorcal::impact
