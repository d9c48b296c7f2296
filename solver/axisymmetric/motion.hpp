#pragma once

#include "solver/axisymmetric/body.hpp"

#include <array>
#include <cstddef>

namespace taylorcal::axisymmetric {

/// What a cell did during its step.
struct Motion {
    /// L: rr, tt, zz, rz = dv_r/dz, zr = dv_z/dr [1/s]
    std::array<double, 5> gradient;
    std::array<double, 4> radial_velocity, axial_velocity;  ///< mean
    double divergence() const { return gradient[0] + gradient[1] + gradient[2]; }
};

/// Brings a cell's corners and ring from its last update to now.
inline Motion move_cell(Body& body, std::size_t cell, double dt) {
    Motion m;
    m.gradient = {};
    std::array<double, 4>& last_r = body.last_radius[cell];
    std::array<double, 4>& last_z = body.last_height[cell];
    std::array<double, 4> mid_r, mid_z;
    const double frequency = 1 / dt;
    for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t n = body.mesh.cells[cell][a];
        const double r = body.radius[n];
        const double z = body.height[n];
        m.radial_velocity[a] = (r - last_r[a]) * frequency;
        m.axial_velocity[a] = (z - last_z[a]) * frequency;
        mid_r[a] = (r + last_r[a]) / 2;
        mid_z[a] = (z + last_z[a]) / 2;
        last_r[a] = r;
        last_z[a] = z;
    }
    const Ring mid = ring_of(mid_r, mid_z);
    const double inverse_volume = 1 / mid.volume;
    for (std::size_t a = 0; a < 4; ++a) {
        const double vr = m.radial_velocity[a] * inverse_volume;
        const double vz = m.axial_velocity[a] * inverse_volume;
        m.gradient[0] += mid.radial[a] * vr;
        m.gradient[1] += mid.hoop[a] * vr;
        m.gradient[2] += mid.axial[a] * vz;
        m.gradient[3] += mid.axial[a] * vr;
        m.gradient[4] += mid.radial[a] * vz;
    }
    body.ring[cell] = ring_of(last_r, last_z);
    return m;
}

}  // namespace taylorcal::axisymmetric
