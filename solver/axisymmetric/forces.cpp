#include "solver/axisymmetric/dynamics.hpp"

#include <algorithm>

namespace taylorcal::axisymmetric {

CornerForces corner_forces(const Body& body, std::size_t cell) {
    const Ring& ring = body.ring[cell];
    const auto& s = body.deviator[cell];
    const double mean = -body.thermo[cell].pressure - body.viscous_pressure[cell];
    const std::array<double, 4>& gamma = body.hourglass_gamma[cell];
    const auto& hourglass = body.hourglass_force[cell];
    CornerForces force{};
    for (std::size_t a = 0; a < 4; ++a) {
        force.radial[a] =
            -((mean + s[0]) * ring.radial[a] + (mean + s[1]) * ring.hoop[a] +
              s[3] * ring.axial[a] + hourglass[0] * gamma[a]);
        force.axial[a] = -((mean + s[2]) * ring.axial[a] + s[3] * ring.radial[a] +
                           hourglass[1] * gamma[a]);
    }
    return force;
}

void push_nodes(Body& body, std::size_t cell, double interval) {
    const auto& corners = body.mesh.cells[cell];
    const CornerForces force = corner_forces(body, cell);
    for (std::size_t a = 0; a < 4; ++a) {
        body.radial_impulse[corners[a]] += interval * force.radial[a];
        body.axial_impulse[corners[a]] += interval * force.axial[a];
    }
}

void accelerate(Body& body, double time_step) {
    if (!body.anvil.rigid_and_smooth()) return body.anvil.accelerate(body, time_step);
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        const bool free_flight = body.radial_impulse[n] == 0 &&
                                 body.axial_impulse[n] == 0 &&
                                 body.height[n] + body.axial_velocity[n] * time_step >= 0;
        if (free_flight) continue;
        const double mass = body.node_mass[n];
        body.radial_velocity[n] += body.radial_impulse[n] / mass;
        if (body.mesh.node_radius[n] == 0) body.radial_velocity[n] = 0;
        const double before = body.axial_velocity[n];
        const double free = before + body.axial_impulse[n] / mass;
        const double reach = -body.height[n] / time_step;  // ends the step on the anvil
        body.axial_velocity[n] = std::max(free, reach);
        // Work of the anvil's impulse, which ends the approach of a node it stops.
        body.balance.contact += (free - body.axial_velocity[n]) * mass *
                                (before + body.axial_velocity[n]) / 2;
    }
}

void drift(Body& body, double time_step) {
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        body.radius[n] += body.radial_velocity[n] * time_step;
        body.height[n] += body.axial_velocity[n] * time_step;
        body.radial_impulse[n] = 0;
        body.axial_impulse[n] = 0;
    }
}

double kinetic_energy(const Body& body) {
    std::vector<double> radial_velocity = body.radial_velocity;
    std::vector<double> axial_velocity = body.axial_velocity;
    for (std::size_t c = 0; c < body.cells(); ++c) {
        const CornerForces force = corner_forces(body, c);
        for (std::size_t a = 0; a < 4; ++a) {
            const std::size_t n = body.mesh.cells[c][a];
            const double half_step = body.cell_step[c] / 2;
            radial_velocity[n] += half_step * force.radial[a] / body.node_mass[n];
            axial_velocity[n] += half_step * force.axial[a] / body.node_mass[n];
        }
    }
    double sum = 0;
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        if (body.mesh.node_radius[n] == 0) radial_velocity[n] = 0;
        const bool rests =
            body.height[n] <= 0 && axial_velocity[n] < body.axial_velocity[n];
        if (rests) axial_velocity[n] = body.axial_velocity[n];  // the anvil bears it
        sum += body.node_mass[n] *
               (radial_velocity[n] * radial_velocity[n] +
                axial_velocity[n] * axial_velocity[n]) /
               2;
    }
    return sum;
}

}  // namespace taylorcal::axisymmetric
