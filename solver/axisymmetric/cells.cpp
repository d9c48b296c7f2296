#include "solver/axisymmetric/dynamics.hpp"

#include <cmath>

#include <fmt/core.h>

namespace taylorcal::axisymmetric {
namespace {

using material::lane_count;
constexpr std::size_t lanes = lane_count<float>;

/// Mean velocity gradient of a cell at mid step.
struct Motion {
    double rr, tt, zz, rz, zr;  ///< L_rz = dv_r/dz, L_zr = dv_z/dr [1/s]
    double divergence() const { return rr + tt + zz; }
};

/// Places of a cell's grains in one block.
void set_lanes(material::BlockInput<float>& input, std::size_t first, std::size_t count,
               const Motion& motion, double density, double temperature, double shear) {
    for (std::size_t lane = first; lane < first + count; ++lane) {
        input.velocity_gradient[0][lane] = static_cast<float>(motion.rr);
        input.velocity_gradient[2][lane] = static_cast<float>(motion.rz);
        input.velocity_gradient[4][lane] = static_cast<float>(motion.tt);
        input.velocity_gradient[6][lane] = static_cast<float>(motion.zr);
        input.velocity_gradient[8][lane] = static_cast<float>(motion.zz);
        input.density[lane] = static_cast<float>(density);
        input.temperature[lane] = static_cast<float>(temperature);
        input.shear_modulus[lane] = static_cast<float>(shear);
    }
}

/// Sums over a cell's grains in one block.
struct GrainSum {
    std::array<double, 4> deviator{};  ///< rr, tt, zz, rz
    double plastic_power = 0;
    double plastic_rate = 0;
    void add(const material::BlockOutput<float>& output, std::size_t first,
             std::size_t count) {
        constexpr std::array<std::size_t, 4> place = {0, 1, 2, 4};
        for (std::size_t lane = first; lane < first + count; ++lane) {
            for (std::size_t i = 0; i < 4; ++i) {
                deviator[i] +=
                    static_cast<double>(output.stress_deviator[place[i]][lane]);
            }
            plastic_power += static_cast<double>(output.plastic_power[lane]);
            plastic_rate += static_cast<double>(output.plastic_rate[lane]);
        }
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

std::string advance_all(Body& body, double dt) {
    const std::size_t grains = static_cast<std::size_t>(body.numerics.grains_per_point);
    const std::size_t cells_a_block = grains < lanes ? lanes / grains : 1;
    const std::size_t blocks_a_cell = grains > lanes ? grains / lanes : 1;
    const std::size_t grains_a_block = std::min(grains, lanes);

    for (std::size_t n = 0; n < body.nodes(); ++n) {
        body.radius[n] += body.radial_velocity[n] * dt;
        body.height[n] += body.axial_velocity[n] * dt;
    }
    material::BlockInput<float> input{};
    input.time_step = static_cast<float>(dt);
    material::BlockOutput<float> output;
    std::array<Motion, lanes> motion{};
    std::array<double, lanes> area{};
    for (std::size_t first = 0; first < body.cells(); first += cells_a_block) {
        const std::size_t last = std::min(first + cells_a_block, body.cells());
        for (std::size_t c = first; c < last; ++c) {
            const auto& corners = body.mesh.cells[c];
            std::array<double, 4> r{}, z{}, mid_r{}, mid_z{};
            for (std::size_t a = 0; a < 4; ++a) {
                const std::size_t n = corners[a];
                r[a] = body.radius[n];
                z[a] = body.height[n];
                mid_r[a] = r[a] - body.radial_velocity[n] * dt / 2;
                mid_z[a] = z[a] - body.axial_velocity[n] * dt / 2;
            }
            const Ring mid = ring_of(mid_r, mid_z);
            Motion& m = motion[c - first];
            m = Motion{};
            for (std::size_t a = 0; a < 4; ++a) {
                const double vr = body.radial_velocity[corners[a]];
                const double vz = body.axial_velocity[corners[a]];
                m.rr += mid.radial[a] * vr / mid.volume;
                m.tt += mid.hoop[a] * vr / mid.volume;
                m.zz += mid.axial[a] * vz / mid.volume;
                m.rz += mid.axial[a] * vr / mid.volume;
                m.zr += mid.radial[a] * vz / mid.volume;
            }
            const Ring end = ring_of(r, z);
            if (!(end.volume > 0) || !(end.area > 0)) {
                return trouble(body, c,
                               std::isfinite(end.volume) ? "a cell folded over"
                                                         : "a position is not finite");
            }
            area[c - first] = end.area;
            body.volume[c] = end.volume;
            set_lanes(input, (c - first) * grains_a_block, grains_a_block, m,
                      body.cell_mass[c] / end.volume, body.thermo[c].temperature,
                      material::shear_modulus(body.thermo[c].bulk_modulus,
                                              body.parameters.poisson_ratio));
        }
        std::array<GrainSum, lanes> sum{};
        for (std::size_t b = 0; b < blocks_a_cell; ++b) {
            body.strength->update(first / cells_a_block * blocks_a_cell + b, input,
                                  output);
            for (std::size_t c = first; c < last; ++c) {
                sum[c - first].add(output, (c - first) * grains_a_block, grains_a_block);
            }
        }
        for (std::size_t c = first; c < last; ++c) {
            const Motion& m = motion[c - first];
            const GrainSum& mean = sum[c - first];
            const double share = 1 / static_cast<double>(grains);
            std::array<double, 4> old = body.deviator[c];
            double shear_power = 0;  // S : D at mid step
            const std::array<double, 4> rate = {m.rr, m.tt, m.zz, m.rz + m.zr};
            for (std::size_t i = 0; i < 4; ++i) {
                body.deviator[c][i] = mean.deviator[i] * share;
                shear_power += (old[i] + body.deviator[c][i]) / 2 * rate[i];
            }
            body.plastic_rate[c] = mean.plastic_rate * share;
            const double plastic_power = mean.plastic_power * share;
            const double density = body.cell_mass[c] / body.volume[c];
            const double old_pressure = body.thermo[c].pressure;
            const double old_viscous = body.viscous_pressure[c];
            const double viscous =
                artificial_viscosity(body, m, density, std::sqrt(area[c - first]),
                                     body.thermo[c].bulk_modulus);
            const double heating = (body.parameters.taylor_quinney * plastic_power -
                                    (old_viscous + viscous) / 2 * m.divergence()) *
                                   dt / density;
            // rho dE/dt = -P div v with the mean of old and new pressure, by one
            // correction.
            const double squeeze = -m.divergence() * dt / density;
            const double predicted = body.energy[c] + heating + old_pressure * squeeze;
            const double guess = body.equation_of_state->at(density, predicted).pressure;
            body.energy[c] += heating + (old_pressure + guess) / 2 * squeeze;
            body.thermo[c] = body.equation_of_state->at(density, body.energy[c]);
            body.viscous_pressure[c] = viscous;
            if (!std::isfinite(body.thermo[c].pressure) || !std::isfinite(shear_power)) {
                return trouble(body, c, "the stress is not finite");
            }
            const double cell_volume = body.volume[c] * dt;
            body.balance.viscous -=
                (old_viscous + viscous) / 2 * m.divergence() * cell_volume;
            body.balance.plastic_work += plastic_power * cell_volume;
            body.balance.internal +=
                ((old_pressure + guess + old_viscous + viscous) / 2 * -m.divergence() +
                 shear_power) *
                cell_volume;
        }
    }
    return {};
}

}  // namespace

std::string advance_cells(Body& body, double dt) {
    std::string trouble;
    simd::run([&](auto) { trouble = advance_all(body, dt); });
    return trouble;
}

}  // namespace taylorcal::axisymmetric
