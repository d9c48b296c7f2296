#pragma once

#include "solver/axisymmetric/body.hpp"

#include <string>

namespace taylorcal::axisymmetric {

/// Nodal forces of the present stresses, artificial viscosity and hourglass control; also
/// returns the largest stable step times `numerics.cfl` [s].
double compute_forces(Body& body);

/// Leapfrog: mid-step velocities from the forces over `interval` (the mean of the last
/// and the next step), with the axis as symmetry line and the anvil as rigid,
/// frictionless wall: a node never passes z = 0, and nothing pulls it there.
void accelerate(Body& body, double interval, double time_step);

/// Moves the nodes by a step and updates volume, stress and energy of every cell. Returns
/// an empty text, or what went wrong and where.
std::string advance_cells(Body& body, double time_step);

}  // namespace taylorcal::axisymmetric
