#pragma once

#include "solver/axisymmetric/body.hpp"

#include <array>

namespace taylorcal::axisymmetric {

/// The two hourglass modes xi eta of a cell, taken beyond a linear velocity field: what
/// each corner adds to a mode's speed, and gets of its force (Flanagan and Belytschko
/// 1981, doi 10.1002/nme.1620170504).
struct HourglassModes {
    std::array<double, 4> gamma;
    double steepness;  ///< 1/side of a square cell of the same slopes [1/m]
};
HourglassModes hourglass_modes(const Ring& ring, const std::array<double, 4>& r,
                               const std::array<double, 4>& z);

/// A cell with one stress point feels nothing of the hourglass modes. Their strain rate
/// over the cell's step is resisted as the metal would: elastically with the shear
/// modulus, relaxing as fast as the cell flows (a Maxwell body of viscosity
/// sigma/(3 rate), the secant of the flow stress), times `numerics.hourglass`; a small
/// viscous part damps their ringing. Sets `Body::hourglass_force` and `hourglass_gamma`,
/// and adds the work to the balance.
void resist_hourglass(Body& body, std::size_t cell,
                      const std::array<double, 4>& radial_velocity,
                      const std::array<double, 4>& axial_velocity);

}  // namespace taylorcal::axisymmetric
