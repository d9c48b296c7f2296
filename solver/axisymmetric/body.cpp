#include "solver/axisymmetric/body.hpp"

#include "solver/material/grain_orientations.hpp"

#include <cmath>
#include <numeric>

namespace taylorcal::axisymmetric {
namespace {

/// int rho N_a dV of a cell's corners, by 2 x 2 Gauss points (exact). Units of rho m3.
std::array<double, 4> corner_volumes(const std::array<double, 4>& r,
                                     const std::array<double, 4>& z) {
    constexpr std::array<double, 4> xi = {-1, 1, 1, -1};
    constexpr std::array<double, 4> eta = {-1, -1, 1, 1};
    const double gauss = 1 / std::sqrt(3.0);
    std::array<double, 4> volumes{};
    for (std::size_t point = 0; point < 4; ++point) {
        const double x = gauss * xi[point];
        const double y = gauss * eta[point];
        std::array<double, 4> shape{};
        double radius = 0;
        double r_xi = 0, r_eta = 0, z_xi = 0, z_eta = 0;
        for (std::size_t a = 0; a < 4; ++a) {
            shape[a] = (1 + xi[a] * x) * (1 + eta[a] * y) / 4;
            radius += shape[a] * r[a];
            r_xi += xi[a] * (1 + eta[a] * y) / 4 * r[a];
            r_eta += eta[a] * (1 + xi[a] * x) / 4 * r[a];
            z_xi += xi[a] * (1 + eta[a] * y) / 4 * z[a];
            z_eta += eta[a] * (1 + xi[a] * x) / 4 * z[a];
        }
        const double ring = 2 * std::numbers::pi * radius * (r_xi * z_eta - r_eta * z_xi);
        for (std::size_t a = 0; a < 4; ++a) volumes[a] += shape[a] * ring;
    }
    return volumes;
}

// A skin may be thinner than a cell: its mean over this many places along each edge.
constexpr int density_samples = 4;

/// Of rhoI(0), by grains; empty if none differs.
std::vector<double> initial_density_factors(const Mesh& mesh, std::size_t grains,
                                            const impact::Additions& additions) {
    std::vector<double> factors;
    if (additions.initial_density.empty()) return factors;
    for (const auto& corners : mesh.cells) {
        double sum = 0;
        for (int i = 0; i < density_samples; ++i) {
            for (int j = 0; j < density_samples; ++j) {
                const double x = (i + 0.5) / density_samples;
                const double y = (j + 0.5) / density_samples;
                const auto place = [&](const std::vector<double>& of_nodes) {
                    return std::lerp(
                        std::lerp(of_nodes[corners[0]], of_nodes[corners[1]], x),
                        std::lerp(of_nodes[corners[3]], of_nodes[corners[2]], x), y);
                };
                double factor = 1;
                for (const auto& rule : additions.initial_density)
                    factor *= rule(place(mesh.node_radius), place(mesh.node_height));
                sum += factor;
            }
        }
        factors.insert(factors.end(), grains, sum / (density_samples * density_samples));
    }
    return factors;
}

}  // namespace

Body::Body(const impact::ImpactCase& impact_case)
    : mesh(make_mesh(impact_case.shape, impact_case.numerics.elements_across_radius,
                     impact_case.numerics.refined_mesh)),
      radius(mesh.node_radius),
      height(mesh.node_height),
      radial_velocity(radius.size(), 0.0),
      axial_velocity(radius.size(), -impact_case.velocity_m_s),
      radial_impulse(radius.size(), 0.0),
      axial_impulse(radius.size(), 0.0),
      node_mass(radius.size(), 0.0),
      equation_of_state(material::make_equation_of_state(impact_case.material)),
      parameters(impact_case.material),
      numerics(impact_case.numerics),
      heated_share(parameters.taylor_quinney - impact_case.additions.unheated_share),
      anvil(mesh, impact_case.additions) {
    const std::size_t count = mesh.cells.size();
    const double initial_energy =
        equation_of_state->energy_at_temperature(impact_case.initial_temperature_K);
    const double density =
        equation_of_state->density_at_temperature(impact_case.initial_temperature_K);
    const material::ThermoState initial = equation_of_state->at(density, initial_energy);
    cell_mass.resize(count);
    energy.assign(count, initial_energy);
    thermo.assign(count, initial);
    deviator.assign(count, {});
    viscous_pressure.assign(count, 0.0);
    plastic_rate.assign(count, 0.0);
    grain_step.assign(count, {});
    hourglass_stress.assign(count, {});
    hourglass_force.assign(count, {});
    cell_step.assign(count, 0.0);
    last_radius.resize(count);
    last_height.resize(count);
    ring.resize(count);
    hourglass_gamma.assign(count, {});
    for (std::size_t c = 0; c < count; ++c) {
        std::array<double, 4> r{}, z{};
        for (std::size_t a = 0; a < 4; ++a) {
            r[a] = radius[mesh.cells[c][a]];
            z[a] = height[mesh.cells[c][a]];
        }
        last_radius[c] = r;
        last_height[c] = z;
        ring[c] = ring_of(r, z);
        cell_mass[c] = ring[c].volume * density;
        const std::array<double, 4> corners = corner_volumes(r, z);
        for (std::size_t a = 0; a < 4; ++a) {
            node_mass[mesh.cells[c][a]] += corners[a] * density;
        }
    }
    const auto grains = static_cast<std::size_t>(numerics.grains_per_point);
    strength = material::make_strength<float>(
        parameters, material::grain_orientations(count, grains, impact_case.seed,
                                                 impact_case.additions.orientations));
    strength->change({impact_case.additions.grains,
                      initial_density_factors(mesh, grains, impact_case.additions)});
    balance.initial_kinetic = std::accumulate(node_mass.begin(), node_mass.end(), 0.0) *
                              impact_case.velocity_m_s * impact_case.velocity_m_s / 2;
}

double sound_speed(const Body& body, std::size_t cell) {
    const double bulk = body.thermo[cell].bulk_modulus;
    const double shear = material::shear_modulus(bulk, body.parameters.poisson_ratio);
    return std::sqrt((bulk + 4.0 / 3 * shear) * body.ring[cell].volume /
                     body.cell_mass[cell]);
}

double von_mises_stress(const std::array<double, 4>& s) {
    return std::sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * s[3] * s[3]));
}

}  // namespace taylorcal::axisymmetric
