#pragma once

#include "solver/material/strength.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace taylorcal::material {

/// What a yield rule is asked about a block of grains, lane by lane.
template <class V>
struct YieldQuestion {
    V trial_stress;              ///< von Mises stress if the step were elastic [Pa]
    V plastic_strain;            ///< equivalent, accumulated before the step
    V temperature;               ///< [K]
    V shear_modulus;             ///< [Pa]
    typename V::Lane time_step;  ///< [s]
};

/// S <- R S R^T with the Cayley map R = (I - W/2)^-1 (I + W/2) of the spin increment W.
/// With the axial vector w of W/2 and s = 2/(1 + w.w), R = I + s (w x) + s (w x)^2.
template <class V>
void rotate_stress(V (&stress)[6], const V& wx, const V& wy, const V& wz) {
    const V s = 2 / (1 + wx * wx + wy * wy + wz * wz);
    const V r[3][3] = {
        {1 - s * (wy * wy + wz * wz), s * (wx * wy - wz), s * (wx * wz + wy)},
        {s * (wx * wy + wz), 1 - s * (wx * wx + wz * wz), s * (wy * wz - wx)},
        {s * (wx * wz - wy), s * (wy * wz + wx), 1 - s * (wx * wx + wy * wy)}};
    const V m[3][3] = {{stress[0], stress[3], stress[4]},
                       {stress[3], stress[1], stress[5]},
                       {stress[4], stress[5], stress[2]}};
    V rm[3][3];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            rm[i][j] = r[i][0] * m[0][j] + r[i][1] * m[1][j] + r[i][2] * m[2][j];
        }
    }
    const auto entry = [&](int i, int j) -> V {
        return rm[i][0] * r[j][0] + rm[i][1] * r[j][1] + rm[i][2] * r[j][2];
    };
    stress[0] = entry(0, 0);
    stress[1] = entry(1, 1);
    stress[2] = entry(2, 2);
    stress[3] = entry(0, 1);
    stress[4] = entry(0, 2);
    stress[5] = entry(1, 2);
}

template <class V>
V contract(const V (&a)[6], const V (&b)[6]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] +
           2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// The frame that the isotropic reference strengths share: a hypoelastic deviator with
/// the Jaumann rate, returned radially to the yield surface. The stress is turned by the
/// orthogonal Cayley map of the spin (Hughes and Winget 1980, doi
/// 10.1002/nme.1620151210), so that a rigid rotation of any size changes no invariant.
///
/// `Rule` has two functions: plastic_increment(YieldQuestion<V>), the growth of the
/// equivalent plastic strain over the step, zero where it is elastic; and
/// yield_stress(plastic_strain), for outputs [Pa].
template <class Rule, class Real, simd::Variant variant>
class HypoelasticStrength final : public Strength<Real> {
  public:
    HypoelasticStrength(const Rule& rule, std::size_t grains)
        : rule_(rule), blocks_((grains + lane_count<Real> - 1) / lane_count<Real>) {
        for (Block& block : blocks_) {
            block = Block{};
            block.shear_modulus = 1;
        }
    }
    void update(std::size_t block, const BlockInput<Real>& input,
                BlockOutput<Real>& output) override {
        simd::on<variant>([&] { advance(blocks_[block], input, output); });
    }
    GrainState state(std::size_t grain) const override;

  private:
    using V = Registers<Real, variant>;
    struct Block {
        V stress[6];       // xx yy zz xy xz yz [Pa]
        V plastic_strain;  // equivalent, accumulated
        V shear_modulus;   // of the last step [Pa]
    };
    void advance(Block& block, const BlockInput<Real>& input,
                 BlockOutput<Real>& output) const;

    Rule rule_;
    std::vector<Block> blocks_;
};

template <class Rule, class Real, simd::Variant variant>
void HypoelasticStrength<Rule, Real, variant>::advance(Block& block,
                                                       const BlockInput<Real>& input,
                                                       BlockOutput<Real>& output) const {
    V gradient[9];
    for (int i = 0; i < 9; ++i) gradient[i] = input.velocity_gradient[i];
    const Real dt = input.time_step;
    const Real quarter = Real(0.25) * dt;
    rotate_stress(block.stress, quarter * (gradient[7] - gradient[5]),
                  quarter * (gradient[2] - gradient[6]),
                  quarter * (gradient[3] - gradient[1]));

    const V third_trace = (gradient[0] + gradient[4] + gradient[8]) / Real(3);
    const V shear_modulus = input.shear_modulus;
    const V twice = 2 * dt * shear_modulus;
    block.stress[0] += twice * (gradient[0] - third_trace);
    block.stress[1] += twice * (gradient[4] - third_trace);
    block.stress[2] += twice * (gradient[8] - third_trace);
    block.stress[3] += twice * (gradient[1] + gradient[3]) / Real(2);
    block.stress[4] += twice * (gradient[2] + gradient[6]) / Real(2);
    block.stress[5] += twice * (gradient[5] + gradient[7]) / Real(2);

    const V trial = lane_sqrt(Real(1.5) * contract(block.stress, block.stress));
    const V increment = rule_.plastic_increment(YieldQuestion<V>{
        trial, block.plastic_strain, input.temperature, shear_modulus, dt});
    const V drop = 3 * shear_modulus * increment;
    const V scale = 1 - drop / (trial + Real(1e-6));
    for (V& component : block.stress) component *= scale;

    block.plastic_strain += increment;
    block.shear_modulus = shear_modulus;
    for (int c = 0; c < 6; ++c) output.stress_deviator[c] = block.stress[c];
    const V rate = increment / dt;
    output.plastic_rate = rate;
    output.plastic_power = (trial - drop) * rate;
}

template <class Rule, class Real, simd::Variant variant>
GrainState HypoelasticStrength<Rule, Real, variant>::state(std::size_t grain) const {
    const Block& block = blocks_[grain / lane_count<Real>];
    const std::size_t lane = grain % lane_count<Real>;
    double stress[6];
    for (int c = 0; c < 6; ++c) stress[c] = static_cast<double>(block.stress[c][lane]);
    GrainState state;
    state.equivalent_plastic_strain = static_cast<double>(block.plastic_strain[lane]);
    state.slip_resistance_Pa = rule_.yield_stress(state.equivalent_plastic_strain);
    state.elastic_shear_energy_J_m3 =
        contract(stress, stress) / (4 * static_cast<double>(block.shear_modulus[lane]));
    return state;
}

/// The strength of `rule`, for what the machine runs.
template <class Real, class Rule>
std::unique_ptr<Strength<Real>> make_hypoelastic(const Rule& rule, std::size_t grains) {
    return simd::with_variant([&](auto chosen) -> std::unique_ptr<Strength<Real>> {
        return std::make_unique<HypoelasticStrength<Rule, Real, chosen.value>>(rule,
                                                                               grains);
    });
}

}  // namespace taylorcal::material
