#pragma once

#include "solver/sph/packing.hpp"
#include "solver/sph/particles.hpp"

#include <cmath>

#include <catch2/catch.hpp>

/// Speeds that alternate between the two interlaced lattices: all hourglass [m/s].
inline void set_alternating_speed(taylorcal::sph::Particles& particles,
                                  const taylorcal::sph::Packing& packing, float speed) {
    for (const taylorcal::sph::Column& column : packing.columns) {
        for (std::size_t k = 0; k < packing.sites_per_column; ++k) {
            const std::size_t slot = column.first_slot + k;
            if (packing.volume[slot] > 0)
                particles.speed[0].lanes()[slot] = column.parity() == 0 ? speed : -speed;
        }
    }
}

/// Mean magnitude of the acceleration across the axis of the particles next to it between
/// two heights, times their mean edge squared.
inline double scaled_acceleration(const taylorcal::sph::Particles& particles,
                                  const taylorcal::sph::Packing& packing, double low,
                                  double high) {
    double sum = 0, edge = 0;
    int count = 0;
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        const double radius = std::hypot(packing.x[slot], packing.y[slot]);
        if (packing.volume[slot] <= 0 || packing.z[slot] < low ||
            packing.z[slot] > high || radius > 0.6 * packing.local_edge[slot])
            continue;
        sum += std::abs(static_cast<double>(particles.acceleration[0].lanes()[slot]));
        edge += packing.local_edge[slot];
        ++count;
    }
    REQUIRE(count > 4);
    return sum / count * std::pow(edge / count, 2);
}
