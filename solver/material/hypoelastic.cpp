#include "solver/material/hypoelastic.hpp"

#include <cmath>

namespace taylorcal::material {

namespace {

/// S <- R S R^T with the Cayley map R = (I - W/2)^-1 (I + W/2) of the spin increment W.
/// With the axial vector w of W/2 and s = 2/(1 + w.w), R = I + s (w x) + s (w x)^2.
template <class V>
void rotate(V stress[6], const V& wx, const V& wy, const V& wz) {
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
V contract(const V a[6], const V b[6]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] +
           2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

}  // namespace

template <class Real>
HypoelasticStrength<Real>::HypoelasticStrength(std::size_t grains)
    : blocks_((grains + lane_count<Real> - 1) / lane_count<Real>) {
    for (Block& block : blocks_) {
        block = Block{};
        block.shear_modulus = broadcast<Real>(1);
    }
}

template <class Real>
void HypoelasticStrength<Real>::update(std::size_t index, const BlockInput<Real>& input,
                                       BlockOutput<Real>& output) {
    using V = Lanes<Real>;
    Block& block = blocks_[index];
    const V* gradient = input.velocity_gradient;
    const Real dt = input.time_step;
    const Real quarter = Real(0.25) * dt;
    rotate<V>(block.stress, quarter * (gradient[7] - gradient[5]),
              quarter * (gradient[2] - gradient[6]),
              quarter * (gradient[3] - gradient[1]));

    const V third_trace = (gradient[0] + gradient[4] + gradient[8]) / Real(3);
    const V twice = 2 * dt * input.shear_modulus;
    block.stress[0] += twice * (gradient[0] - third_trace);
    block.stress[1] += twice * (gradient[4] - third_trace);
    block.stress[2] += twice * (gradient[8] - third_trace);
    block.stress[3] += twice * (gradient[1] + gradient[3]) / Real(2);
    block.stress[4] += twice * (gradient[2] + gradient[6]) / Real(2);
    block.stress[5] += twice * (gradient[5] + gradient[7]) / Real(2);

    V trial = Real(1.5) * contract(block.stress, block.stress);
    for (std::size_t k = 0; k < lane_count<Real>; ++k) trial[k] = std::sqrt(trial[k]);
    const V increment = plastic_increment(
        {trial, block.plastic_strain, input.temperature, input.shear_modulus, dt});
    const V drop = 3 * input.shear_modulus * increment;
    const V scale = 1 - drop / (trial + Real(1e-6));
    for (V& component : block.stress) component *= scale;

    block.plastic_strain += increment;
    block.shear_modulus = input.shear_modulus;
    for (int c = 0; c < 6; ++c) output.stress_deviator[c] = block.stress[c];
    output.plastic_rate = increment / dt;
    output.plastic_power = (trial - drop) * output.plastic_rate;
}

template <class Real>
GrainState HypoelasticStrength<Real>::state(std::size_t grain) const {
    const Block& block = blocks_[grain / lane_count<Real>];
    const std::size_t lane = grain % lane_count<Real>;
    double stress[6];
    for (int c = 0; c < 6; ++c) stress[c] = static_cast<double>(block.stress[c][lane]);
    GrainState state;
    state.equivalent_plastic_strain = static_cast<double>(block.plastic_strain[lane]);
    state.slip_resistance_Pa = yield_stress(state.equivalent_plastic_strain);
    state.elastic_shear_energy_J_m3 =
        contract(stress, stress) / (4 * static_cast<double>(block.shear_modulus[lane]));
    return state;
}

template class HypoelasticStrength<float>;
template class HypoelasticStrength<double>;

}  // namespace taylorcal::material
