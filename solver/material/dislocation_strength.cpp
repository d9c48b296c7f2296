#include "solver/material/dislocation_strength.hpp"

#include "solver/material/crystal_frame.hpp"
#include "solver/material/dislocation_hooks.hpp"
#include "solver/material/microstructure.hpp"
#include "solver/material/slip_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taylorcal::material {
namespace {

// A substep may strain a grain by at most this.
constexpr double largest_strain_increment = 1e-3;
// A substep may multiply the mobile density of a system by at most this above one: at
// first yield it grows tenfold within nanoseconds and decides the upper yield point.
template <class Real>
constexpr double largest_growth = sizeof(Real) == 4 ? 0.04 : 0.01;
// A step is never cut into more than about as many substeps.
constexpr double most_substeps = 200;

template <class V>
double largest_lane(const V& values) {
    double largest = 0;
    for (std::size_t lane = 0; lane < lane_count<typename V::Lane>; ++lane)
        largest = std::max(largest, static_cast<double>(values[lane]));
    return largest;
}

}  // namespace

template <class Real, simd::Variant variant>
DislocationStrength<Real, variant>::DislocationStrength(
    const Parameters& parameters, const std::vector<Eigen::Quaterniond>& orientations)
    : parameters_(parameters) {
    constexpr std::size_t lanes = lane_count<Real>;
    blocks_.resize((orientations.size() + lanes - 1) / lanes);
    for (std::size_t n = 0; n < blocks_.size(); ++n) {
        Block& block = blocks_[n];
        block = Block{};
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t grain = std::min(n * lanes + lane, orientations.size() - 1);
            const Eigen::Matrix3d matrix =
                orientations[grain].normalized().toRotationMatrix();
            for (int i = 0; i < 9; ++i)
                block.orientation[i][lane] = static_cast<Real>(matrix(i / 3, i % 3));
        }
        for (std::size_t d = 0; d < slip_system_count; ++d) {
            block.mobile[d] = parameters.rho_mobile_initial;
            block.immobile[d] = parameters.rho_immobile_initial;
        }
        block.initial_resistance = parameters.initial_yield_stress;
        block.shear_modulus = 1;
        block.next_substep = std::numeric_limits<double>::infinity();
    }
}

/// Ys = Ys0 + AI G b sqrt(sum of rhoI), Eq. 20 [Pa].
template <class Real, simd::Variant variant>
auto DislocationStrength<Real, variant>::hardening(const Block& block,
                                                   const V& shear_modulus) const -> V {
    V total = block.immobile[0];
    for (std::size_t d = 1; d < slip_system_count; ++d) total += block.immobile[d];
    const double scale = parameters_.hardening_coefficient * parameters_.burgers_vector;
    return block.initial_resistance + scale * shear_modulus * lane_sqrt(total);
}

/// Moves the block by the step's duration, shortened until no system multiplies too much,
/// and asks for the next duration.
template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::substep(Block& block, Step& step,
                                                 double shortest, Slip& slip) const {
    slip = Slip{};
    if (!block.slips && is_elastic(block, step)) return rest(block, step);
    if (block.rest_time > 0) end_rest(block);
    Outcome outcome;
    for (;;) {
        solve_stress(block, step, slip, outcome);
        evolve_densities(block, step, slip, outcome);
        const double excess = largest_lane(outcome.growth) / largest_growth<Real>;
        const auto duration = static_cast<double>(step.duration);
        block.next_substep = duration / std::max(excess, 0.5);
        if (!(excess > 2) || duration <= shortest * (1 + 1e-6))
            return accept(outcome, step, block, slip);
        step.duration =
            static_cast<Real>(std::max(shortest, duration / std::min(excess, 4.0)));
    }
}

template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::advance(Block& block,
                                                 const BlockInput<Real>& input,
                                                 BlockOutput<Real>& output) const {
    Step step;
    V gradient[9];
    for (int i = 0; i < 9; ++i) gradient[i] = input.velocity_gradient[i];
    // The lattice at mid step sees the velocity gradient; the stress answers at the end.
    const Real half_step = input.time_step / 2;
    rotate_with_spin(gradient, half_step, block.orientation);
    strain_rate_in_crystal(block.orientation, gradient, step.rate, step.dilatation);
    rotate_with_spin(gradient, half_step, block.orientation);
    step.shear_modulus = input.shear_modulus;
    step.sound_speed = lane_sqrt(step.shear_modulus / V(input.density));
    step.drag = parameters_.drag_constant + parameters_.drag_slope * V(input.temperature);
    // S follows dS = 2 G de. With S = 2 G(P) e of a large e the pressure would change S,
    // but no strain the pressure in return: vibrations of metal that hardly slips would
    // gain energy.
    const V kept = block.shear_modulus / step.shear_modulus;  // 1 if it stays the same
    for (int k = 0; k < 5; ++k) block.elastic[k] *= kept;
    block.shear_modulus = step.shear_modulus;
    block.temperature = input.temperature;
    step.duration = input.time_step;

    V plastic_before[5];
    std::copy(block.plastic, block.plastic + 5, plastic_before);
    V square_rate = {};
    for (int k = 0; k < 5; ++k) square_rate += step.rate[k] * step.rate[k];
    const double total = static_cast<double>(input.time_step);
    const double shortest = total / most_substeps;
    const double longest =
        largest_strain_increment / std::sqrt(largest_lane(square_rate));
    double left = total;
    V work = {};
    while (left > 0) {
        const double wanted =
            std::clamp(block.next_substep, shortest, std::max(shortest, longest));
        const double count = std::max(1.0, std::ceil(left / wanted));
        step.duration = static_cast<Real>(left / count);
        Slip slip;
        Lean lean;
        before_slip(block, lean);
        substep(block, step, shortest, slip);
        after_slip(lean, step, block, slip);
        work += slip.power * step.duration;
        // The last part of a step takes all of it, whatever the rounding.
        const auto duration = static_cast<double>(step.duration);
        left = duration < left * (1 - 1e-6) ? left - duration : 0;
    }
    output.plastic_power = work / input.time_step;
    V square = {};
    for (int k = 0; k < 5; ++k) {
        const V increment = block.plastic[k] - plastic_before[k];
        square += increment * increment;
    }
    output.plastic_rate =
        lane_sqrt(square * static_cast<Real>(2.0 / 3)) / input.time_step;

    V stress[5], deviator[6];
    for (int k = 0; k < 5; ++k) stress[k] = 2 * step.shear_modulus * block.elastic[k];
    deviator_in_lab(block.orientation, stress, deviator);
    for (int c = 0; c < 6; ++c) output.stress_deviator[c] = deviator[c];
}

/// Whether no system of any grain reaches its threshold if the step is elastic.
template <class Real, simd::Variant variant>
bool DislocationStrength<Real, variant>::is_elastic(const Block& block,
                                                    const Step& step) const {
    V trial[5];
    for (int k = 0; k < 5; ++k)
        trial[k] = block.elastic[k] + step.duration * step.rate[k];
    V largest = {};
    for_each_slip_system(
        [&](auto d) { largest = lane_max(largest, lane_abs(resolve<d.value>(trial))); });
    const V threshold = hardening(block, step.shear_modulus) / 2;
    return !any_lane(2 * step.shear_modulus * largest > threshold);
}

/// An elastic step: what the dislocations do meanwhile is left to the end of the rest.
template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::rest(Block& block, const Step& step) const {
    for (int k = 0; k < 5; ++k) {
        block.elastic[k] += step.duration * step.rate[k];
        block.elastic_rate[k] = step.rate[k];
    }
    block.rest_dilatation += step.duration * step.dilatation;
    block.rest_time += static_cast<double>(step.duration);
    block.next_substep = 2 * static_cast<double>(step.duration);
    std::fill(block.drag_root, block.drag_root + slip_system_count, V{});
}

/// Without slip, Eqs. 15-16 leave immobilization and dilution. The former keeps
/// S = rhoI + rhoD - rhoDfree, so that drhoI/dt = VI (S - rhoI) sqrt(rhoI), which has a
/// closed form.
template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::end_rest(Block& block) const {
    const V rho_free = parameters_.rho_mobile_free;
    const V half_path = parameters_.immobilization_velocity * block.rest_time / 2;
    const V least = 1;
    const V dilution =
        lane_map(-block.rest_dilatation, [](Real x) { return std::exp(x); });
    for (std::size_t d = 0; d < slip_system_count; ++d) {
        const V sum = lane_max(block.mobile[d] - rho_free + block.immobile[d], least);
        const V root = lane_sqrt(sum);
        const V before = lane_sqrt(block.immobile[d]);
        const V progress =
            lane_map(root * half_path, [](Real x) { return std::tanh(x); });
        const V after = root * (before + root * progress) / (root + before * progress);
        const V captured = (after - before) * (after + before);
        block.mobile[d] = lane_max((block.mobile[d] - captured) * dilution, least);
        block.immobile[d] = lane_max((block.immobile[d] + captured) * dilution, least);
    }
    block.rest_dilatation = V{};
    block.rest_time = 0;
}

/// Backward Euler for e: e + dt sum_d M^d b rhoD V(e) sign = e_old + dt dev(D), Eqs.
/// 4-14.
template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::solve_stress(Block& block, const Step& step,
                                                      Slip& slip,
                                                      Outcome& outcome) const {
    const V dt = step.duration;
    const auto b = static_cast<Real>(parameters_.burgers_vector);
    const V two_g = 2 * step.shear_modulus;
    const V resistance = hardening(block, step.shear_modulus);
    const V threshold = resistance / 2;
    const V scale = b / (step.sound_speed * step.drag);  // zeta per Pa of excess stress
    const V slope_scale = dt * b * step.sound_speed * scale * two_g;

    for (std::size_t part = 0; part < V::parts; ++part) {
        SlipEquations<typename V::One> equations;
        equations.two_g = two_g.one(part);
        equations.threshold = threshold.one(part);
        equations.scale = scale.one(part);
        equations.sound_speed = step.sound_speed.one(part);
        equations.slope_scale = slope_scale.one(part);
        equations.slip_scale = step.duration * b;
        for (int k = 0; k < 5; ++k) {
            equations.old[k] = block.elastic[k].one(part);
            equations.trial[k] =
                equations.old[k] + step.duration * step.rate[k].one(part);
            equations.e[k] =
                equations.old[k] + step.duration * block.elastic_rate[k].one(part);
        }
        for (std::size_t d = 0; d < slip_system_count; ++d) {
            equations.mobile[d] = block.mobile[d].one(part);
            equations.root[d] = block.drag_root[d].one(part);
        }
        equations.solve();
        for (int k = 0; k < 5; ++k) outcome.elastic[k].set_one(part, equations.e[k]);
        for (std::size_t d = 0; d < slip_system_count; ++d) {
            block.drag_root[d].set_one(part, equations.root[d]);
            slip.speed[d].set_one(part, equations.speed[d]);
            slip.force[d].set_one(part, b * equations.excess[d]);
        }
    }
}

/// Kinetics of Eqs. 15-19 and the annihilated energy of Eq. 21, sinks implicit.
/// Generation at a given slip rate falls as 1/rhoD (X = B gamma/(b rhoD)); integrated
/// exactly it is rhoD -> sqrt(rhoD^2 + 2 rhoD QD dt), which holds over steps in which
/// rhoD doubles.
template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::evolve_densities(const Block& block,
                                                          const Step& step,
                                                          const Slip& slip,
                                                          Outcome& outcome) const {
    const Parameters& p = parameters_;
    const V dt = step.duration;
    const V generation = (1 - p.taylor_quinney) / (p.dislocation_energy * electron_volt) *
                         p.burgers_vector;
    const V ka_b = p.annihilation_coefficient * p.burgers_vector;
    const V vi = p.immobilization_velocity;
    const V rho_free = p.rho_mobile_free;
    const V line_energy = p.dislocation_energy * electron_volt / p.burgers_vector;
    V annihilation = {};
    outcome.growth = V{};
    for (std::size_t d = 0; d < slip_system_count; ++d) {
        const V mobile = block.mobile[d];
        const V immobile = block.immobile[d];
        const V capture = vi * immobile * lane_inverse_sqrt(immobile);
        const V sweep = ka_b * slip.speed[d];
        const V growth = 2 * dt * generation * slip.force[d] * slip.speed[d];
        const V generated = mobile * (1 + growth) * lane_inverse_sqrt(1 + growth);
        const V next = (generated + dt * capture * rho_free) *
                       lane_inverse(1 + dt * (capture + sweep * (2 * mobile + immobile) +
                                              step.dilatation));
        const V next_immobile = (immobile + dt * capture * (next - rho_free)) *
                                lane_inverse(1 + dt * (sweep * next + step.dilatation));
        annihilation += sweep * next * (2 * next + 2 * next_immobile);
        outcome.mobile[d] = next;
        outcome.immobile[d] = lane_max(next_immobile, V(1));
        // Systems emptied by annihilation refill from rhoDfree, which decides nothing.
        outcome.growth = lane_max(
            outcome.growth, (next - mobile) * lane_inverse(lane_max(mobile, rho_free)));
    }
    outcome.annihilated_energy =
        block.annihilated_energy + dt * line_energy * annihilation;
}

/// The plastic strain is what the elastic strain left of the total, and the work is done
/// on that strain, so that both add up whatever the last iteration of the stress changed.
template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::accept(const Outcome& outcome, const Step& step,
                                                Block& block, Slip& slip) const {
    V work = {};
    for (int k = 0; k < 5; ++k) {
        const V increment =
            block.elastic[k] + step.duration * step.rate[k] - outcome.elastic[k];
        work += outcome.elastic[k] * increment;
        block.elastic_rate[k] = (outcome.elastic[k] - block.elastic[k]) / step.duration;
        block.plastic[k] += increment;
        block.elastic[k] = outcome.elastic[k];
    }
    slip.power = 2 * step.shear_modulus * work / step.duration;
    std::copy(outcome.mobile, outcome.mobile + slip_system_count, block.mobile);
    std::copy(outcome.immobile, outcome.immobile + slip_system_count, block.immobile);
    block.annihilated_energy = outcome.annihilated_energy;
    V fastest = {};
    for (std::size_t d = 0; d < slip_system_count; ++d)
        fastest = lane_max(fastest, slip.speed[d]);
    block.slips = any_lane(fastest > 0);
}

template <class Real, simd::Variant variant>
GrainState DislocationStrength<Real, variant>::state(std::size_t grain) const {
    Block block = blocks_[grain / lane_count<Real>];
    simd::on<variant>([&] { end_rest(block); });
    const std::size_t lane = grain % lane_count<Real>;
    GrainState state;
    double plastic = 0;
    double elastic = 0;
    for (int k = 0; k < 5; ++k) {
        plastic += std::pow(static_cast<double>(block.plastic[k][lane]), 2);
        elastic += std::pow(static_cast<double>(block.elastic[k][lane]), 2);
    }
    for (std::size_t d = 0; d < slip_system_count; ++d) {
        state.mobile_density_m2 += static_cast<double>(block.mobile[d][lane]);
        state.immobile_density_m2 += static_cast<double>(block.immobile[d][lane]);
    }
    state.equivalent_plastic_strain = std::sqrt(2.0 / 3 * plastic);
    state.elastic_shear_energy_J_m3 =
        static_cast<double>(block.shear_modulus[lane]) * elastic;
    state.slip_resistance_Pa = static_cast<double>(block.initial_resistance[lane]) +
                               parameters_.hardening_coefficient *
                                   static_cast<double>(block.shear_modulus[lane]) *
                                   parameters_.burgers_vector *
                                   std::sqrt(state.immobile_density_m2);
    state.annihilated_energy_J_m3 = static_cast<double>(block.annihilated_energy[lane]);
    state.grain_diameter_m = grain_diameter(parameters_, state.annihilated_energy_J_m3);
    state.weakened_fraction =
        weakened_fraction(parameters_, state.annihilated_energy_J_m3);
    return state;
}

template <class Real>
std::unique_ptr<Strength<Real>> make_dislocation_strength(
    const Parameters& parameters, const std::vector<Eigen::Quaterniond>& orientations) {
    return simd::with_variant([&](auto variant) -> std::unique_ptr<Strength<Real>> {
        return std::make_unique<DislocationStrength<Real, variant.value>>(parameters,
                                                                          orientations);
    });
}

template std::unique_ptr<Strength<float>> make_dislocation_strength(
    const Parameters&, const std::vector<Eigen::Quaterniond>&);
template std::unique_ptr<Strength<double>> make_dislocation_strength(
    const Parameters&, const std::vector<Eigen::Quaterniond>&);

}  // namespace taylorcal::material
