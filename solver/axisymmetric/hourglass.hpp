#pragma once

#include "solver/axisymmetric/body.hpp"

#include <array>

namespace taylorcal::axisymmetric {

/// Nodal forces against the two hourglass modes of a cell [N], and their power [W].
struct HourglassForce {
    std::array<double, 4> radial;
    std::array<double, 4> axial;
    double power;
};

/// A cell with one stress point feels nothing of the velocity modes xi eta. Their strain
/// rate is resisted as the metal would: elastically with the shear modulus, relaxing as
/// fast as the cell flows (a Maxwell body of viscosity sigma/(3 rate), the secant of the
/// flow stress), times `numerics.hourglass`; a small viscous part damps their ringing.
/// Modes are taken beyond a linear velocity field (Flanagan and Belytschko 1981,
/// doi 10.1002/nme.1620170504). `impedance` is rho c of the cell, `shear` its modulus.
HourglassForce hourglass_force(Body& body, std::size_t cell, const Ring& ring,
                               const std::array<double, 4>& r,
                               const std::array<double, 4>& z,
                               const std::array<double, 4>& radial_velocity,
                               const std::array<double, 4>& axial_velocity,
                               double impedance, double shear);

}  // namespace taylorcal::axisymmetric
