#pragma once

#include "solver/axisymmetric/body.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace taylorcal::axisymmetric {

// Asynchronous leapfrog (Lew, Marsden, Ortiz and West 2003, doi
// 10.1007/s00205-002-0212-y): a cell updates its stress and pushes its nodes once in its
// own step, `Body::cell_step`, and nodes coast between the impulses. Each cell's forces
// add up to nothing along z, so that impulses keep the momentum whatever the steps; with
// one step for all this is the ordinary leapfrog.

/// Strain, volume, stress, energy and stable step of the cells first ... last - 1, whose
/// nodes have moved for the cells' own steps; the cells of one block of grains come
/// together. Returns an empty text, or what went wrong and where.
std::string update_cells(Body& body, std::size_t first, std::size_t last);

/// On a cell's corners, outward and upward [N].
struct CornerForces {
    std::array<double, 4> radial, axial;
};

/// Of a cell's stresses, artificial viscosity and hourglass control.
CornerForces corner_forces(const Body& body, std::size_t cell);

/// Gives a cell's nodes the impulse of its forces over `interval` (the mean of its last
/// and its next step) [s].
void push_nodes(Body& body, std::size_t cell, double interval);

/// Velocities from the impulses, with the axis as symmetry line and the anvil as rigid,
/// frictionless wall: within the next `time_step` a node never passes z = 0, and nothing
/// pulls it there.
void accelerate(Body& body, double time_step);

/// Moves the nodes by their velocities and forgets the impulses.
void drift(Body& body, double time_step);

/// At the end of a cycle, when every cell's forces are known [J]: nodes' velocities are
/// those of mid step, and each cell's forces act on them for the other half of its step.
double kinetic_energy(const Body& body);

}  // namespace taylorcal::axisymmetric
