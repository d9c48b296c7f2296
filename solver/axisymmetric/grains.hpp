#pragma once

#include "solver/axisymmetric/body.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace taylorcal::axisymmetric {

inline constexpr std::size_t grain_lanes = lane_count<float>;

/// Places of a cell's `count` grains in one block.
template <std::size_t count>
void set_lanes(material::BlockInput<float>& input, std::size_t first,
               const std::array<double, 5>& mean, double density, double temperature,
               double shear) {
    const auto fill = [first](Lanes<float>& block, double value) {
        std::fill_n(block.data() + first, count, static_cast<float>(value));
    };
    const double gradient[9] = {mean[0], 0, mean[3], 0, mean[1], 0, mean[4], 0, mean[2]};
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
    std::array<double, 4> deviator{};  ///< rr, tt, zz, rz [Pa]
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

/// Moves the grains of the cells first ... last - 1 of one group for all the time since
/// they last moved, at its mean velocity gradient: `grains_a_block` of each cell's grains
/// lie in one block, all of a cell or a blockful. Sets the cells' deviators and plastic
/// rates; returns the plastic work of each cell over that time [J/m3].
template <std::size_t grains_a_block>
std::array<double, grain_lanes / grains_a_block> move_grains(Body& body,
                                                             std::size_t first,
                                                             std::size_t last) {
    constexpr std::size_t most = grain_lanes / grains_a_block;
    const std::size_t grains = static_cast<std::size_t>(body.numerics.grains_per_point);
    const double time = body.grain_step[first].time();
    material::BlockInput<float> input;
    if (last - first < most) input = {};  // lanes without a grain
    input.time_step = static_cast<float>(time);
    std::array<double, most> shear_modulus{};
    for (std::size_t c = first; c < last; ++c) {
        // The modulus of the step's end: one that lags behind the volume feeds the
        // ringing of metal under large elastic strain.
        const double density = body.cell_mass[c] / body.ring[c].volume;
        const double modulus =
            body.equation_of_state->at(density, body.energy[c]).bulk_modulus;
        shear_modulus[c - first] =
            material::shear_modulus(modulus, body.parameters.poisson_ratio);
        set_lanes<grains_a_block>(input, (c - first) * grains_a_block,
                                  body.grain_step[c].mean_gradient(), density,
                                  body.thermo[c].temperature, shear_modulus[c - first]);
    }
    material::BlockOutput<float> output;
    std::array<GrainSum, most> sum;
    const std::size_t first_block = first * grains / grain_lanes;
    for (std::size_t b = 0; b < grains / grains_a_block; ++b) {
        body.strength->update(first_block + b, input, output);
        for (std::size_t c = first; c < last; ++c)
            sum[c - first].template add<grains_a_block>(output,
                                                        (c - first) * grains_a_block);
    }
    std::array<double, most> work{};
    for (std::size_t c = first; c < last; ++c) {
        GrainSum& mean = sum[c - first];
        mean.divide(grains);
        work[c - first] = mean.plastic_power * time;
        body.plastic_rate[c] = mean.plastic_rate;
        body.deviator[c] = mean.deviator;
        body.grain_step[c].finish(mean.deviator, shear_modulus[c - first],
                                  mean.plastic_rate > 0);
    }
    return work;
}

}  // namespace taylorcal::axisymmetric
