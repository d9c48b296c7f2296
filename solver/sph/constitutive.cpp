#include "solver/sph/constitutive.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::sph {

namespace {

/// The least principal stretch from below: 1/sqrt of a bound on the largest eigenvalue of
/// F^-1 F^-T, by the Frobenius norm of its square (at most 15 % short, for F = 1).
template <class Vector>
Vector least_stretch(const Vector (&inverse)[9]) {
    Vector a[6];  // F^-1 F^-T: xx yy zz xy xz yz
    const auto row_product = [&](int i, int j) -> Vector {
        return inverse[3 * i] * inverse[3 * j] + inverse[3 * i + 1] * inverse[3 * j + 1] +
               inverse[3 * i + 2] * inverse[3 * j + 2];
    };
    a[0] = row_product(0, 0);
    a[1] = row_product(1, 1);
    a[2] = row_product(2, 2);
    a[3] = row_product(0, 1);
    a[4] = row_product(0, 2);
    a[5] = row_product(1, 2);
    const Vector xx = a[0] * a[0] + a[3] * a[3] + a[4] * a[4];
    const Vector yy = a[3] * a[3] + a[1] * a[1] + a[5] * a[5];
    const Vector zz = a[4] * a[4] + a[5] * a[5] + a[2] * a[2];
    const Vector xy = a[0] * a[3] + a[3] * a[1] + a[4] * a[5];
    const Vector xz = a[0] * a[4] + a[3] * a[5] + a[4] * a[2];
    const Vector yz = a[3] * a[4] + a[1] * a[5] + a[5] * a[2];
    const Vector squares =
        xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz);
    return lane_inverse_sqrt(lane_sqrt(lane_sqrt(squares)));
}

/// Whether a particle's deformation has gone wrong. Written so that NaN counts as wrong.
template <class Vector>
bool is_tangled(const Vector& ratio, const Vector (&rate)[9], float step) {
    constexpr float least_ratio = 0.5f;  // copper at some 400 GPa
    constexpr float largest_ratio = 2;
    constexpr float largest_strain = 0.5f;  // within a step
    Vector squares{};
    for (const Vector& component : rate) squares += component * component;
    const auto sound = (ratio > least_ratio) & (ratio < largest_ratio) &
                       (step * step * squares < largest_strain * largest_strain);
    return any_lane(~sound);
}

/// S : D for a deviator and a velocity gradient.
template <class Vector>
Vector power(const Vector (&s)[6], const Vector (&l)[9]) {
    return s[0] * l[0] + s[1] * l[4] + s[2] * l[8] + s[3] * (l[1] + l[3]) +
           s[4] * (l[2] + l[6]) + s[5] * (l[5] + l[7]);
}

/// J sigma F^-T, with sigma = S - p I.
template <class Vector>
void first_piola_kirchhoff(const Vector (&s)[6], const Vector& pressure, const Vector& j,
                           const Vector (&inverse)[9], Vector (&stress)[9]) {
    const Vector sigma[9] = {s[0] - pressure, s[3], s[4], s[3],
                             s[1] - pressure, s[5], s[4], s[5],
                             s[2] - pressure};
    const Vector transposed[9] = {inverse[0], inverse[3], inverse[6],
                                  inverse[1], inverse[4], inverse[7],
                                  inverse[2], inverse[5], inverse[8]};
    multiply(sigma, transposed, stress);
    for (Vector& component : stress) component *= j;
}

template <class Vector>
double sum(const Vector& v) {
    double total = 0;
    for (std::size_t k = 0; k < block_size; ++k) total += static_cast<double>(v[k]);
    return total;
}

}  // namespace

Rest rest_state(const material::EquationOfState& equation_of_state, double temperature) {
    const double density = equation_of_state.density_at_temperature(temperature);
    const double energy = equation_of_state.energy_at_temperature(temperature);
    return {density, energy, equation_of_state.at(density, energy)};
}

Constitutive::Constitutive(const impact::ImpactCase& impact_case, const Packing& packing,
                           const material::EquationOfState& equation_of_state,
                           const Rest& rest,
                           std::unique_ptr<material::Strength<float>> strength)
    : packing_(packing),
      equation_of_state_(equation_of_state),
      strength_(std::move(strength)),
      grain_steps_(packing.active.size()),
      grains_(static_cast<std::size_t>(impact_case.numerics.grains_per_point)),
      rest_(rest),
      shear_ratio_(material::shear_modulus(1, impact_case.material.poisson_ratio)),
      heated_share_(static_cast<float>(impact_case.material.taylor_quinney -
                                       impact_case.additions.unheated_share)),
      linear_viscosity_(static_cast<float>(impact_case.numerics.linear_viscosity)),
      quadratic_viscosity_(static_cast<float>(impact_case.numerics.quadratic_viscosity)),
      edge_(packing.slots),
      misfit_stiffness_(packing.slots) {
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        const double edge = packing.local_edge[slot];
        edge_.lanes()[slot] = static_cast<float>(edge);
        misfit_stiffness_.lanes()[slot] =
            static_cast<float>(impact_case.numerics.hourglass * edge * edge);
    }
}

std::vector<double> Constitutive::initialise(Particles& particles) const {
    const double modulus = rest_.state.bulk_modulus * (1 + 4.0 / 3 * shear_ratio_);
    const double sound_speed = std::sqrt(modulus / rest_.density);
    std::vector<double> sound_times;
    for (const std::size_t block : packing_.active) {
        for (std::size_t k = 0; k < block_size; ++k) {
            particles.energy[block * block_size + k] = rest_.energy;
        }
        particles.temperature[block] = static_cast<float>(rest_.state.temperature);
        particles.bulk_modulus[block] = static_cast<float>(rest_.state.bulk_modulus);
        particles.density[block] = static_cast<float>(rest_.density);
        const float* edges = edge_.lanes() + block * block_size;
        sound_times.push_back(
            static_cast<double>(*std::min_element(edges, edges + block_size)) /
            sound_speed);
    }
    return sound_times;
}

template <class Vector>
Constitutive::Response<Vector> Constitutive::move_grains(std::size_t index,
                                                         const Particles& particles,
                                                         const Vector& density) {
    const std::size_t block = packing_.active[index];
    GrainStep& grain_step = grain_steps_[index];
    Vector gradient[9];
    grain_step.mean_gradient(gradient);
    const Vector shear_modulus =
        static_cast<float>(shear_ratio_) * particles.bulk_modulus[block];
    material::BlockInput<float> input;
    std::copy(std::begin(gradient), std::end(gradient), input.velocity_gradient);
    input.density = density;
    input.temperature = particles.temperature[block];
    input.shear_modulus = shear_modulus;
    input.time_step = static_cast<float>(grain_step.time());
    Vector deviator[6] = {}, plastic_power{}, plastic_rate{};
    for (std::size_t g = 0; g < grains_; ++g) {
        material::BlockOutput<float> output;
        strength_->update(index * grains_ + g, input, output);
        for (int c = 0; c < 6; ++c) deviator[c] += output.stress_deviator[c];
        plastic_power += output.plastic_power;
        plastic_rate += output.plastic_rate;
    }
    const float share = 1.0f / static_cast<float>(grains_);
    Response<Vector> response;
    for (int c = 0; c < 6; ++c) response.deviator[c] = deviator[c] * share;
    plastic_power *= share;
    response.plastic_work = plastic_power * static_cast<float>(grain_step.time());
    grain_step.finish(response.deviator, plastic_power, plastic_rate, shear_modulus);
    return response;
}

template <class Vector>
Constitutive::Response<Vector> Constitutive::respond(std::size_t index,
                                                     const Particles& particles,
                                                     const Vector (&gradient)[9],
                                                     const Vector& density, float step) {
    if (grain_steps_[index].take(gradient, step))
        return move_grains(index, particles, density);
    Response<Vector> response{};
    for (std::size_t c = 0; c < 6; ++c)
        response.deviator[c] = particles.stress_deviator[c][packing_.active[index]];
    grain_steps_[index].predict(gradient, step, response.deviator);
    return response;
}

template <class Vector>
MisfitResistance<Vector> Constitutive::misfit_resistance(
    std::size_t index, const Vector (&s)[6], const Vector& shear_modulus) const {
    constexpr float least_square = 1e6f;  // of a stress [Pa2]: there is no slip below
    const Vector square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] +
                          2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
    const Vector slip = lane_max(Vector(grain_steps_[index].plastic_power()), Vector{});
    return {2 * misfit_stiffness_[packing_.active[index]] * shear_modulus,
            2 * shear_modulus * slip * lane_inverse(square + least_square)};
}

/// rho dE/dt = -P div v + heating, with the pressure averaged over the step.
template <class Vector>
void Constitutive::close_energy(Particles& particles, std::size_t block,
                                const Vector& dilatation, const Vector& density,
                                const Vector& heating, double dt) const {
    for (std::size_t k = 0; k < block_size; ++k) {
        const std::size_t slot = block * block_size + k;
        if (packing_.volume[slot] <= 0) continue;
        const double after = static_cast<double>(density[k]);
        const double before = static_cast<double>(particles.density[block][k]);
        const double share = dt / (0.5 * (before + after));
        const double div = static_cast<double>(dilatation[k]);
        const double old_pressure = static_cast<double>(particles.pressure[block][k]);
        double& energy = particles.energy[slot];
        energy += share * (static_cast<double>(heating[k]) - old_pressure * div);
        const material::ThermoState state = equation_of_state_.at(after, energy);
        energy -= 0.5 * share * (state.pressure - old_pressure) * div;
        particles.pressure[block][k] = static_cast<float>(state.pressure);
        particles.temperature[block][k] = static_cast<float>(state.temperature);
        particles.bulk_modulus[block][k] = static_cast<float>(state.bulk_modulus);
    }
    particles.density[block] = density;
}

double Constitutive::update(Particles& particles, const Reference& reference,
                            std::size_t index, double dt) {
    double sound_time = 0;
    simd::run([&](auto chosen) {
        sound_time =
            advance<Registers<float, chosen.value>>(particles, reference, index, dt);
    });
    return sound_time;
}

template <class Vector>
double Constitutive::advance(Particles& particles, const Reference& reference,
                             std::size_t index, double dt) {
    const auto step = static_cast<float>(dt);
    const auto rho0 = static_cast<float>(rest_.density);
    const auto stiffness = static_cast<float>(1 + 4.0 / 3 * shear_ratio_);
    const std::size_t block = packing_.active[index];
    Vector end[9], middle[9], rate[9], gradient[9], inverse[9];
    for (std::size_t c = 0; c < 9; ++c) {
        rate[c] = particles.rate[c][block];
        double* f = particles.deformation[c].data() + block * block_size;
        for (std::size_t k = 0; k < block_size; ++k) {
            f[k] += dt * static_cast<double>(rate[c][k]);
        }
        end[c] = rounded(f);
        middle[c] = end[c] - 0.5f * step * rate[c];
    }
    const Vector middle_ratio = invert(middle, inverse);
    multiply(rate, inverse, gradient);
    const Vector ratio = invert(end, inverse);
    if (is_tangled(ratio, rate, step)) return 0;
    const Vector density = rho0 * lane_inverse(ratio);
    const Vector dilatation = gradient[0] + gradient[4] + gradient[8];

    const Response<Vector> response = respond(index, particles, gradient, density, step);
    const Vector spacing = edge_[block] * least_stretch(inverse);
    const Vector sound_speed =
        lane_sqrt(stiffness * particles.bulk_modulus[block] * lane_inverse(density));
    const Vector closing = lane_max(-dilatation, Vector{});
    const Vector viscosity =
        density * spacing * closing *
        (quadratic_viscosity_ * spacing * closing + linear_viscosity_ * sound_speed);

    const auto resistance = misfit_resistance(
        index, response.deviator,
        Vector(static_cast<float>(shear_ratio_) * particles.bulk_modulus[block]));
    const Vector hourglass = resist_misfit(particles, block, resistance, step);
    const Vector heating = heated_share_ / step * response.plastic_work +
                           viscosity * closing + hourglass * lane_inverse(middle_ratio);
    close_energy(particles, block, dilatation, density, heating, dt);

    Vector mean[6];
    for (std::size_t c = 0; c < 6; ++c) {
        mean[c] = 0.5f * (particles.stress_deviator[c][block] + response.deviator[c]);
        particles.stress_deviator[c][block] = response.deviator[c];
    }
    Vector stress[9];
    first_piola_kirchhoff(response.deviator, particles.pressure[block] + viscosity, ratio,
                          inverse, stress);
    reference.store_pull(particles, block, stress);

    const Vector volume = reference.volume()[block];
    const Vector volume_step = volume * middle_ratio * step;
    const double plastic = sum(volume * middle_ratio * response.plastic_work);
    work_.plastic += plastic;
    work_.stored_in_shear += sum(volume_step * power(mean, gradient)) -
                             static_cast<double>(heated_share_) * plastic;
    work_.viscous += sum(volume_step * viscosity * closing);
    work_.hourglass += sum(volume * step * hourglass);

    const Vector time = spacing * lane_inverse(sound_speed);
    double least_time = INFINITY;
    for (std::size_t k = 0; k < block_size; ++k) {
        least_time = std::min(least_time, static_cast<double>(time[k]));
    }
    return least_time;
}

material::GrainState Constitutive::state(std::size_t index, std::size_t lane) const {
    material::GrainState mean;
    for (std::size_t g = 0; g < grains_; ++g) {
        const material::GrainState s =
            strength_->state((index * grains_ + g) * block_size + lane);
        mean.equivalent_plastic_strain += s.equivalent_plastic_strain;
        mean.slip_resistance_Pa += s.slip_resistance_Pa;
        mean.mobile_density_m2 += s.mobile_density_m2;
        mean.immobile_density_m2 += s.immobile_density_m2;
        mean.annihilated_energy_J_m3 += s.annihilated_energy_J_m3;
        mean.grain_diameter_m += s.grain_diameter_m;
        mean.weakened_fraction += s.weakened_fraction;
        mean.elastic_shear_energy_J_m3 += s.elastic_shear_energy_J_m3;
    }
    const double share = 1 / static_cast<double>(grains_);
    for (double* value : {&mean.equivalent_plastic_strain, &mean.slip_resistance_Pa,
                          &mean.mobile_density_m2, &mean.immobile_density_m2,
                          &mean.annihilated_energy_J_m3, &mean.grain_diameter_m,
                          &mean.weakened_fraction, &mean.elastic_shear_energy_J_m3}) {
        *value *= share;
    }
    return mean;
}

}  // namespace taylorcal::sph
