#pragma once

#include "solver/material/grain_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace taylorcal::axisymmetric {

/// A cell's grains take longer steps than the cell, see material::GrainStepLimits.
///
/// Velocity gradients L are rr, tt, zz, rz, zr [1/s], deviators S rr, tt, zz, rz [Pa].
class GrainStep {
  public:
    using Gradient = std::array<double, 5>;
    using Deviator = std::array<double, 4>;

    /// Takes a step of the cell in; returns whether the grains must move with it, since
    /// another step like this would be too much.
    bool take(const Gradient& l, double dt) {
        const double third = (l[0] + l[1] + l[2]) / 3;
        double square = l[3] * l[3] + l[4] * l[4];
        for (std::size_t i = 0; i < 3; ++i) square += (l[i] - third) * (l[i] - third);
        for (std::size_t i = 0; i < 5; ++i) displacement_[i] += l[i] * dt;
        time_ += dt;
        const double increment = std::sqrt(square) * dt;
        strain_ += increment;
        return stiffness_ == 0 || strain_ + increment > bearable_strain_;
    }

    /// Since the grains last moved [s].
    double time() const { return time_; }
    /// The mean of L over that time.
    Gradient mean_gradient() const {
        Gradient mean = displacement_;
        for (double& component : mean) component /= time_;
        return mean;
    }

    /// Changes the deviator as far as the cell's step does without a move of the grains.
    void predict(const Gradient& l, double dt, Deviator& deviator) const {
        const Deviator rate = strain_rate(l);
        // What was elastic, or did no work, says nothing of how slip depends on the rate.
        double share = 1;
        if (inverse_power_ > 0)
            share = std::clamp(product(stress_, rate) * inverse_power_,
                               -Limits::share_of_slip, Limits::share_of_slip);
        for (std::size_t i = 0; i < 4; ++i)
            deviator[i] += dt * (stiffness_ * rate[i] - share * relaxation_[i]);
    }

    /// The grains have moved for time() at the mean gradient, with the shear modulus
    /// [Pa], and answer with `deviator`; `slips` if any of them has slipped.
    void finish(const Deviator& deviator, double shear_modulus, bool slips) {
        const Deviator rate = strain_rate(mean_gradient());
        stiffness_ = 2 * shear_modulus;
        for (std::size_t i = 0; i < 4; ++i)
            relaxation_[i] = stiffness_ * rate[i] - (deviator[i] - stress_[i]) / time_;
        stress_ = deviator;
        const double elastic_strain = std::sqrt(product(stress_, stress_)) / stiffness_;
        bearable_strain_ = slips
                               ? std::clamp(Limits::share_of_elastic * elastic_strain,
                                            Limits::least_strain, Limits::largest_strain)
                               : Limits::largest_strain;
        const double power = product(stress_, rate);
        inverse_power_ = power > 0 ? 1 / power : 0;
        displacement_ = {};
        strain_ = time_ = 0;
    }

  private:
    using Limits = material::GrainStepLimits;

    static Deviator strain_rate(const Gradient& l) {
        const double third = (l[0] + l[1] + l[2]) / 3;
        return {l[0] - third, l[1] - third, l[2] - third, (l[3] + l[4]) / 2};
    }
    static double product(const Deviator& a, const Deviator& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * a[3] * b[3];
    }

    double time_ = 0;
    double strain_ = 0;           // int |L - 1/3 tr L| dt since the last move
    Gradient displacement_{};     // int L dt since then
    Deviator stress_{};           // S after it [Pa]
    Deviator relaxation_{};       // what slip and turning took from dS/dt [Pa/s]
    double inverse_power_ = 0;    // 1/(S : D) of it, or 0 [m3/W]
    double bearable_strain_ = 0;  // until the next
    double stiffness_ = 0;        // 2 G of it, 0 before the first [Pa]
};

}  // namespace taylorcal::axisymmetric
