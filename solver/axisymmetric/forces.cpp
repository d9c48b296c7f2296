#include "solver/axisymmetric/dynamics.hpp"
#include "solver/axisymmetric/hourglass.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::axisymmetric {
namespace {

/// Longest side or diagonal of a cell, squared.
double longest_square(const std::array<double, 4>& r, const std::array<double, 4>& z) {
    double longest = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t b = (a + 1) % 4;
        longest = std::max(longest, std::pow(r[b] - r[a], 2) + std::pow(z[b] - z[a], 2));
    }
    return longest;
}

}  // namespace

double compute_forces(Body& body) {
    std::fill(body.radial_force.begin(), body.radial_force.end(), 0.0);
    std::fill(body.axial_force.begin(), body.axial_force.end(), 0.0);
    double stable = std::numeric_limits<double>::infinity();
    double hourglass_power = 0;
    for (std::size_t c = 0; c < body.cells(); ++c) {
        const auto& corners = body.mesh.cells[c];
        std::array<double, 4> r{}, z{}, vr{}, vz{};
        for (std::size_t a = 0; a < 4; ++a) {
            r[a] = body.radius[corners[a]];
            z[a] = body.height[corners[a]];
            vr[a] = body.radial_velocity[corners[a]];
            vz[a] = body.axial_velocity[corners[a]];
        }
        const Ring ring = ring_of(r, z);
        const auto& s = body.deviator[c];
        const double mean = -body.thermo[c].pressure - body.viscous_pressure[c];
        const double density = body.cell_mass[c] / ring.volume;
        const double shear = material::shear_modulus(body.thermo[c].bulk_modulus,
                                                     body.parameters.poisson_ratio);
        const double sound =
            std::sqrt((body.thermo[c].bulk_modulus + 4.0 / 3 * shear) / density);
        const double width = ring.area / std::sqrt(longest_square(r, z));
        const double viscous_speed =
            4 * body.viscous_pressure[c] / (density * sound);  // slows the stable step
        stable = std::min(stable, width / (sound + viscous_speed));

        const HourglassForce hourglass =
            hourglass_force(body, c, ring, r, z, vr, vz, density * sound, shear);
        hourglass_power += hourglass.power;
        for (std::size_t a = 0; a < 4; ++a) {
            body.radial_force[corners[a]] -= (mean + s[0]) * ring.radial[a] +
                                             (mean + s[1]) * ring.hoop[a] +
                                             s[3] * ring.axial[a] + hourglass.radial[a];
            body.axial_force[corners[a]] -= (mean + s[2]) * ring.axial[a] +
                                            s[3] * ring.radial[a] + hourglass.axial[a];
        }
    }
    body.balance.hourglass += hourglass_power * body.time_step;
    return stable * body.numerics.cfl;
}

void accelerate(Body& body, double interval, double time_step) {
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        const double mass = body.node_mass[n];
        body.radial_velocity[n] += body.radial_force[n] / mass * interval;
        if (body.mesh.node_radius[n] == 0) body.radial_velocity[n] = 0;
        const double before = body.axial_velocity[n];
        const double free = before + body.axial_force[n] / mass * interval;
        const double reach = -body.height[n] / time_step;  // ends the step on the anvil
        body.axial_velocity[n] = std::max(free, reach);
        // Work of the anvil's impulse, which ends the approach of a node it stops.
        body.balance.contact += (free - body.axial_velocity[n]) * mass *
                                (before + body.axial_velocity[n]) / 2;
    }
}

}  // namespace taylorcal::axisymmetric
