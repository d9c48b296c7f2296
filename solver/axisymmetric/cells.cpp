#include "solver/axisymmetric/dynamics.hpp"
#include "solver/axisymmetric/hourglass.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <fmt/core.h>

namespace taylorcal::axisymmetric {
namespace {

constexpr std::size_t lanes = lane_count<float>;

/// What a cell did during its step.
struct Motion {
    double rr, tt, zz, rz,
        zr;     ///< velocity gradient, L_rz = dv_r/dz, L_zr = dv_z/dr [1/s]
    Ring ring;  ///< at the end
    std::array<double, 4> radius, height;  ///< of the corners, at the end
    std::array<double, 4> radial_velocity, axial_velocity;  ///< mean
    double divergence() const { return rr + tt + zz; }
};

Motion motion_of(const Body& body, std::size_t cell, double dt) {
    Motion m{};
    std::array<double, 4> mid_r{}, mid_z{};
    for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t n = body.mesh.cells[cell][a];
        m.radius[a] = body.radius[n];
        m.height[a] = body.height[n];
        m.radial_velocity[a] = (m.radius[a] - body.last_radius[cell][a]) / dt;
        m.axial_velocity[a] = (m.height[a] - body.last_height[cell][a]) / dt;
        mid_r[a] = (m.radius[a] + body.last_radius[cell][a]) / 2;
        mid_z[a] = (m.height[a] + body.last_height[cell][a]) / 2;
    }
    const Ring mid = ring_of(mid_r, mid_z);
    for (std::size_t a = 0; a < 4; ++a) {
        const double vr = m.radial_velocity[a] / mid.volume;
        const double vz = m.axial_velocity[a] / mid.volume;
        m.rr += mid.radial[a] * vr;
        m.tt += mid.hoop[a] * vr;
        m.zz += mid.axial[a] * vz;
        m.rz += mid.axial[a] * vr;
        m.zr += mid.radial[a] * vz;
    }
    m.ring = ring_of(m.radius, m.height);
    return m;
}

/// Places of a cell's `count` grains in one block.
template <std::size_t count>
void set_lanes(material::BlockInput<float>& input, std::size_t first,
               const Motion& motion, double density, double temperature, double shear) {
    const auto fill = [first](Lanes<float>& block, double value) {
        std::fill_n(block.data() + first, count, static_cast<float>(value));
    };
    const double gradient[9] = {motion.rr, 0,         motion.rz, 0,        motion.tt,
                                0,         motion.zr, 0,         motion.zz};
    for (std::size_t i = 0; i < 9; ++i) fill(input.velocity_gradient[i], gradient[i]);
    fill(input.density, density);
    fill(input.temperature, temperature);
    fill(input.shear_modulus, shear);
}

/// Sum of `count` lanes (a power of two), by halves.
template <std::size_t count>
double sum_of(const Lanes<float>& values, std::size_t first) {
    std::array<double, count> part;
    for (std::size_t lane = 0; lane < count; ++lane)
        part[lane] = static_cast<double>(values.data()[first + lane]);
#pragma GCC unroll 4
    for (std::size_t half = count / 2; half > 0; half /= 2)
        for (std::size_t lane = 0; lane < half; ++lane) part[lane] += part[lane + half];
    return part[0];
}

/// Sums over a cell's grains in one block.
struct GrainSum {
    std::array<double, 4> deviator{};  ///< rr, tt, zz, rz
    double plastic_power = 0;
    double plastic_rate = 0;
    template <std::size_t count>
    void add(const material::BlockOutput<float>& output, std::size_t first) {
        constexpr std::array<std::size_t, 4> place = {0, 1, 2, 4};
        for (std::size_t i = 0; i < 4; ++i)
            deviator[i] += sum_of<count>(output.stress_deviator[place[i]], first);
        plastic_power += sum_of<count>(output.plastic_power, first);
        plastic_rate += sum_of<count>(output.plastic_rate, first);
    }
    void divide(std::size_t grains) {
        const double share = 1 / static_cast<double>(grains);
        for (double& component : deviator) component *= share;
        plastic_power *= share;
        plastic_rate *= share;
    }
};

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

/// Viscosity, pressure and energy of a cell after its grains have moved for `dt`, and
/// what that adds to the energy balance.
void close_energy(Body& body, std::size_t c, const Motion& m, const GrainSum& mean,
                  const std::array<double, 4>& old_deviator, double dt) {
    const std::array<double, 4> rate = {m.rr, m.tt, m.zz, m.rz + m.zr};
    double shear_power = 0;  // S : D at mid step
    for (std::size_t i = 0; i < 4; ++i)
        shear_power += (old_deviator[i] + body.deviator[c][i]) / 2 * rate[i];
    const double density = body.cell_mass[c] / body.volume[c];
    const double old_pressure = body.thermo[c].pressure;
    const double old_viscous = body.viscous_pressure[c];
    const double viscous = artificial_viscosity(body, m, density, std::sqrt(m.ring.area),
                                                body.thermo[c].bulk_modulus);
    const double heating = (body.heated_share * mean.plastic_power -
                            (old_viscous + viscous) / 2 * m.divergence()) *
                           dt / density;
    // rho dE/dt = -P div v with the mean of old and new pressure.
    const double squeeze = -m.divergence() * dt / density;
    const double predicted = body.energy[c] + heating + old_pressure * squeeze;
    body.thermo[c] = body.equation_of_state->at(density, predicted);
    const double pressure = (old_pressure + body.thermo[c].pressure) / 2;
    body.energy[c] += heating + pressure * squeeze;
    body.viscous_pressure[c] = viscous;
    const double cell_volume = body.volume[c] * dt;
    body.balance.viscous -= (old_viscous + viscous) / 2 * m.divergence() * cell_volume;
    body.balance.plastic_work += mean.plastic_power * cell_volume;
    body.balance.internal +=
        ((pressure + (old_viscous + viscous) / 2) * -m.divergence() + shear_power) *
        cell_volume;
}

/// `grains_a_block` of each cell's grains lie in one block: all of a cell, or a blockful.
template <std::size_t grains_a_block>
std::string update_group(Body& body, std::size_t first, std::size_t last) {
    const std::size_t grains = static_cast<std::size_t>(body.numerics.grains_per_point);
    const std::size_t blocks_a_cell = grains / grains_a_block;
    const double dt = body.cell_step[first];

    material::BlockInput<float> input;
    if (last - first < lanes / grains_a_block) input = {};  // lanes without a grain
    input.time_step = static_cast<float>(dt);
    material::BlockOutput<float> output;
    std::array<Motion, lanes / grains_a_block> motion;
    for (std::size_t c = first; c < last; ++c) {
        Motion& m = motion[c - first];
        m = motion_of(body, c, dt);
        if (!(m.ring.volume > 0) || !(m.ring.area > 0)) {
            return trouble(body, c,
                           std::isfinite(m.ring.volume) ? "a cell folded over"
                                                        : "a position is not finite");
        }
        body.volume[c] = m.ring.volume;
        body.last_radius[c] = m.radius;
        body.last_height[c] = m.height;
        // The modulus of the step's end: one that lags behind the volume feeds the
        // ringing of metal under large elastic strain.
        const double density = body.cell_mass[c] / m.ring.volume;
        const double modulus =
            body.equation_of_state->at(density, body.energy[c]).bulk_modulus;
        set_lanes<grains_a_block>(
            input, (c - first) * grains_a_block, m, density, body.thermo[c].temperature,
            material::shear_modulus(modulus, body.parameters.poisson_ratio));
    }
    body.clock.mark(impact::Phase::gradients);
    std::array<GrainSum, lanes / grains_a_block> sum;
    const std::size_t first_block = first * grains / lanes;
    for (std::size_t b = 0; b < blocks_a_cell; ++b) {
        body.strength->update(first_block + b, input, output);
        for (std::size_t c = first; c < last; ++c)
            sum[c - first].template add<grains_a_block>(output,
                                                        (c - first) * grains_a_block);
    }
    body.clock.mark(impact::Phase::plasticity);
    for (std::size_t c = first; c < last; ++c) {
        GrainSum& mean = sum[c - first];
        mean.divide(grains);
        const Motion& m = motion[c - first];
        const std::array<double, 4> old = std::exchange(body.deviator[c], mean.deviator);
        body.plastic_rate[c] = mean.plastic_rate;
        close_energy(body, c, m, mean, old, dt);
        resist_hourglass(body, c, m.ring, m.radius, m.height, m.radial_velocity,
                         m.axial_velocity);
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
            update(std::integral_constant<std::size_t, lanes>());
    }
    return trouble;
}

}  // namespace taylorcal::axisymmetric
