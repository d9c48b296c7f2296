#include "solver/axisymmetric/dynamics.hpp"
#include "solver/axisymmetric/grains.hpp"
#include "solver/axisymmetric/hourglass.hpp"
#include "solver/axisymmetric/motion.hpp"

#include <array>
#include <cmath>
#include <type_traits>

#include <fmt/core.h>

namespace taylorcal::axisymmetric {
namespace {

/// Artificial viscosity q = rho w |div v| (c1 c + c2 w |div v|) in compression [Pa].
double artificial_viscosity(const Body& body, const Motion& motion, double density,
                            double width, double bulk_modulus) {
    const double closing = -motion.divergence() * width;
    if (!(closing > 0)) return 0;
    const double sound = std::sqrt(bulk_modulus / density);
    return density * closing *
           (body.numerics.linear_viscosity * sound +
            body.numerics.quadratic_viscosity * closing);
}

[[gnu::noinline]] std::string trouble(const Body& body, std::size_t cell,
                                      const std::string& what) {
    const auto& corners = body.mesh.cells[cell];
    return fmt::format("{} at r = {:.3f} mm, z = {:.3f} mm after {:.2f} us", what,
                       1e3 * body.radius[corners[0]], 1e3 * body.height[corners[0]],
                       1e6 * body.time);
}

/// Viscosity, pressure and energy of a cell after a step `dt` that has changed its
/// deviator, with the plastic work [J/m3] of its grains if they have moved; and what that
/// adds to the energy balance.
void close_energy(Body& body, std::size_t c, const Motion& m,
                  const std::array<double, 4>& old_deviator, double plastic_work,
                  double dt) {
    const auto& l = m.gradient;
    const std::array<double, 4> rate = {l[0], l[1], l[2], l[3] + l[4]};
    double shear_power = 0;  // S : D at mid step
    for (std::size_t i = 0; i < 4; ++i)
        shear_power += (old_deviator[i] + body.deviator[c][i]) / 2 * rate[i];
    const double density = body.cell_mass[c] / body.ring[c].volume;
    const double old_pressure = body.thermo[c].pressure;
    const double old_viscous = body.viscous_pressure[c];
    const double viscous = artificial_viscosity(
        body, m, density, std::sqrt(body.ring[c].area), body.thermo[c].bulk_modulus);
    const double heating = (body.heated_share * plastic_work -
                            (old_viscous + viscous) / 2 * m.divergence() * dt) /
                           density;
    // rho dE/dt = -P div v with the mean of old and new pressure.
    const double squeeze = -m.divergence() * dt / density;
    const double predicted = body.energy[c] + heating + old_pressure * squeeze;
    body.thermo[c] = body.equation_of_state->at(density, predicted);
    const double pressure = (old_pressure + body.thermo[c].pressure) / 2;
    body.energy[c] += heating + pressure * squeeze;
    body.viscous_pressure[c] = viscous;
    const double cell_volume = body.ring[c].volume * dt;
    body.balance.viscous -= (old_viscous + viscous) / 2 * m.divergence() * cell_volume;
    body.balance.plastic_work += plastic_work * body.ring[c].volume;
    body.balance.internal +=
        ((pressure + (old_viscous + viscous) / 2) * -m.divergence() + shear_power) *
        cell_volume;
}

/// Moves the cells first ... last - 1 of one group, and their grains if it is time.
template <std::size_t grains_a_block>
std::string update_group(Body& body, std::size_t first, std::size_t last) {
    constexpr std::size_t most = grain_lanes / grains_a_block;
    const double dt = body.cell_step[first];
    std::array<Motion, most> motion;
    std::array<std::array<double, 4>, most> old_deviator;
    bool time_to_move = false;
    for (std::size_t c = first; c < last; ++c) {
        Motion& m = motion[c - first];
        m = move_cell(body, c, dt);
        if (!(body.ring[c].volume > 0) || !(body.ring[c].area > 0)) {
            return trouble(body, c,
                           std::isfinite(body.ring[c].volume)
                               ? "a cell folded over"
                               : "a position is not finite");
        }
        old_deviator[c - first] = body.deviator[c];
        time_to_move |= body.grain_step[c].take(m.gradient, dt);
    }
    body.clock.mark(impact::Phase::gradients);
    std::array<double, most> plastic_work{};
    if (time_to_move) {
        plastic_work = move_grains<grains_a_block>(body, first, last);
    } else {
        for (std::size_t c = first; c < last; ++c)
            body.grain_step[c].predict(motion[c - first].gradient, dt, body.deviator[c]);
    }
    body.clock.mark(impact::Phase::plasticity);
    for (std::size_t c = first; c < last; ++c) {
        const Motion& m = motion[c - first];
        close_energy(body, c, m, old_deviator[c - first], plastic_work[c - first], dt);
        resist_hourglass(body, c, m.radial_velocity, m.axial_velocity);
        if (!std::isfinite(body.thermo[c].pressure + body.deviator[c][0]))
            return trouble(body, c, "the stress is not finite");
    }
    body.clock.mark(impact::Phase::forces);
    body.cell_updates += static_cast<std::int64_t>(last - first);
    return {};
}

}  // namespace

std::string update_cells(Body& body, std::size_t first, std::size_t last) {
    std::string trouble;
    const auto update = [&](auto grains_a_block) {
        simd::run([&](auto) {
            trouble = update_group<grains_a_block.value>(body, first, last);
        });
    };
    // Sums and copies over a constant number of lanes take vectors.
    switch (body.numerics.grains_per_point) {
        case 1:
            update(std::integral_constant<std::size_t, 1>());
            break;
        case 2:
            update(std::integral_constant<std::size_t, 2>());
            break;
        case 4:
            update(std::integral_constant<std::size_t, 4>());
            break;
        case 8:
            update(std::integral_constant<std::size_t, 8>());
            break;
        default:
            update(std::integral_constant<std::size_t, grain_lanes>());
    }
    return trouble;
}

}  // namespace taylorcal::axisymmetric
