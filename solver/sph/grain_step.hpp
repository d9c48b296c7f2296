#pragma once

#include "solver/material/grain_step.hpp"
#include "solver/sph/field.hpp"

namespace taylorcal::sph {

/// The grains of a block of particles take longer steps than the particles, see
/// material::GrainStepLimits: all of a block together, when one particle's must.
///
/// Velocity gradients L are row-major [1/s], deviators S xx yy zz xy xz yz [Pa].
class GrainStep {
  public:
    /// Takes a step of the particles in; returns whether the grains must move with it,
    /// since another step like this would be too much.
    template <class V>
    bool take(const V (&l)[9], float dt) {
        const V third = (l[0] + l[4] + l[8]) * (1.0f / 3);
        V square{};
        for (int i = 0; i < 9; ++i) {
            const V part = i % 4 == 0 ? l[i] - third : l[i];
            square += part * part;
            displacement_[i] = V(displacement_[i]) + dt * l[i];
        }
        time_ += static_cast<double>(dt);
        const V increment = dt * lane_sqrt(square);
        const V strain = V(strain_) + increment;
        strain_ = strain;
        return !begun_ || any_lane(strain + increment > V(bearable_strain_));
    }

    /// Since the grains last moved [s].
    double time() const { return time_; }
    /// The mean of L over that time.
    template <class V>
    void mean_gradient(V (&l)[9]) const {
        const auto per_time = static_cast<float>(1 / time_);
        for (int i = 0; i < 9; ++i) l[i] = per_time * V(displacement_[i]);
    }
    /// S : plastic strain rate, mean over the last move [W/m3].
    const Vector& plastic_power() const { return plastic_power_; }

    /// Changes the deviator as far as the particles' step does without a move.
    template <class V>
    void predict(const V (&l)[9], float dt, V (&deviator)[6]) const {
        constexpr auto largest = static_cast<float>(Limits::share_of_slip);
        V rate[6], stress[6];
        strain_rate(l, rate);
        for (int i = 0; i < 6; ++i) stress[i] = stress_[i];
        const V inverse = inverse_power_;
        // What was elastic, or did no work, says nothing of how slip depends on the rate.
        V share = clamped(product(stress, rate) * inverse, -largest, largest);
        share = lane_select(inverse > V{}, share, V(1.0f));
        for (int i = 0; i < 6; ++i)
            deviator[i] += dt * (V(stiffness_) * rate[i] - share * V(relaxation_[i]));
    }

    /// The grains have moved for time() at the mean gradient, with the shear modulus
    /// [Pa], and answer with `deviator`, their power and rate of plastic strain.
    template <class V>
    void finish(const V (&deviator)[6], const V& plastic_power, const V& plastic_rate,
                const V& shear_modulus) {
        V mean[9], rate[6];
        mean_gradient(mean);
        strain_rate(mean, rate);
        const V stiffness = 2 * shear_modulus;
        const auto per_time = static_cast<float>(1 / time_);
        for (int i = 0; i < 6; ++i) {
            relaxation_[i] =
                stiffness * rate[i] - per_time * (deviator[i] - V(stress_[i]));
            stress_[i] = deviator[i];
        }
        const V elastic_strain =
            lane_sqrt(product(deviator, deviator)) * lane_inverse(stiffness);
        constexpr auto largest = static_cast<float>(Limits::largest_strain);
        const V bearable =
            clamped(static_cast<float>(Limits::share_of_elastic) * elastic_strain,
                    static_cast<float>(Limits::least_strain), largest);
        bearable_strain_ = lane_select(plastic_rate > V{}, bearable, V(largest));
        const V power = product(deviator, rate);
        inverse_power_ =
            lane_select(power > V{}, lane_inverse(lane_max(power, V(1.0f))), V{});
        stiffness_ = stiffness;
        plastic_power_ = plastic_power;
        for (Vector& component : displacement_) component = Vector{};
        strain_ = Vector{};
        time_ = 0;
        begun_ = true;
    }

  private:
    using Limits = material::GrainStepLimits;

    template <class V>
    static V clamped(const V& value, float low, float high) {
        return -lane_max(-lane_max(value, V(low)), V(-high));
    }
    template <class V>
    static void strain_rate(const V (&l)[9], V (&rate)[6]) {
        const V third = (l[0] + l[4] + l[8]) * (1.0f / 3);
        rate[0] = l[0] - third;
        rate[1] = l[4] - third;
        rate[2] = l[8] - third;
        rate[3] = 0.5f * (l[1] + l[3]);
        rate[4] = 0.5f * (l[2] + l[6]);
        rate[5] = 0.5f * (l[5] + l[7]);
    }
    template <class V>
    static V product(const V (&a)[6], const V (&b)[6]) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] +
               2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
    }

    double time_ = 0;
    bool begun_ = false;
    Vector strain_{};           // int |L - 1/3 tr L| dt since the last move
    Vector displacement_[9]{};  // int L dt since then
    Vector stress_[6]{};        // S after it [Pa]
    Vector relaxation_[6]{};    // what slip and turning took from dS/dt [Pa/s]
    Vector inverse_power_{};    // 1/(S : D) of it, or 0 [m3/W]
    Vector bearable_strain_{};  // until the next
    Vector stiffness_{};        // 2 G of it [Pa]
    Vector plastic_power_{};
};

}  // namespace taylorcal::sph
