#pragma once

#include "common/simd.hpp"

#include <cmath>

#include <Eigen/Core>

namespace taylorcal::emulator {

/// Adam (Kingma and Ba 2015, arXiv 1412.6980, algorithm 1) with decoupled weight decay
/// (Loshchilov and Hutter 2019, arXiv 1711.05101) on a flat vector of parameters.
template <typename Scalar>
class Adam {
  public:
    using Vector = Eigen::Array<Scalar, Eigen::Dynamic, 1>;

    explicit Adam(Eigen::Index parameters)
        : mean_(Vector::Zero(parameters)), square_(Vector::Zero(parameters)) {}

    /// `decay` holds each parameter's decay rate (0 for those that must not shrink).
    template <typename Decay>
    void step(Vector& parameters, const Vector& gradient, Scalar learning_rate,
              const Eigen::ArrayBase<Decay>& decay) {
        ++steps_;
        const auto unbias_1 = static_cast<Scalar>(1 / (1 - std::pow(beta_1, steps_)));
        const auto unbias_2 = static_cast<Scalar>(1 / (1 - std::pow(beta_2, steps_)));
        const Vector decays = decay;
        Scalar* p = parameters.data();
        Scalar* mean = mean_.data();
        Scalar* square = square_.data();
        simd::run([&](auto) {
            for (Eigen::Index i = 0; i < parameters.size(); ++i) {
                const Scalar g = gradient.data()[i];
                mean[i] += (1 - beta_1) * (g - mean[i]);
                square[i] += (1 - beta_2) * (g * g - square[i]);
                p[i] -= learning_rate * (unbias_1 * mean[i] /
                                             (std::sqrt(unbias_2 * square[i]) + epsilon) +
                                         decays.data()[i] * p[i]);
            }
        });
    }

  private:
    static constexpr Scalar beta_1 = static_cast<Scalar>(0.9);
    static constexpr Scalar beta_2 = static_cast<Scalar>(0.999);
    static constexpr Scalar epsilon = static_cast<Scalar>(1e-8);
    Vector mean_;
    Vector square_;
    long steps_ = 0;
};

}  // namespace taylorcal::emulator
