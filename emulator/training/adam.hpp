#pragma once

#include "common/simd.hpp"

#include <cmath>
#include <utility>

#include <Eigen/Core>

namespace taylorcal::emulator {

/// What Adam remembers of the steps before.
template <typename Scalar>
struct AdamState {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> mean;    ///< of the gradient
    Eigen::Array<Scalar, Eigen::Dynamic, 1> square;  ///< mean of the gradient's square
    long steps = 0;
};

/// Adam (Kingma and Ba 2015, arXiv 1412.6980, algorithm 1) with decoupled weight decay
/// (Loshchilov and Hutter 2019, arXiv 1711.05101) on a flat vector of parameters.
template <typename Scalar>
class Adam {
  public:
    using Vector = Eigen::Array<Scalar, Eigen::Dynamic, 1>;

    explicit Adam(Eigen::Index parameters)
        : state_{Vector::Zero(parameters), Vector::Zero(parameters), 0} {}
    /// Goes on from a state that was kept.
    explicit Adam(AdamState<Scalar> state) : state_(std::move(state)) {}

    const AdamState<Scalar>& state() const { return state_; }

    /// `decay` holds each parameter's decay rate (0 for those that must not shrink).
    template <typename Decay>
    void step(Vector& parameters, const Vector& gradient, Scalar learning_rate,
              const Eigen::ArrayBase<Decay>& decay) {
        ++state_.steps;
        const auto unbias_1 =
            static_cast<Scalar>(1 / (1 - std::pow(beta_1, state_.steps)));
        const auto unbias_2 =
            static_cast<Scalar>(1 / (1 - std::pow(beta_2, state_.steps)));
        const Vector decays = decay;
        Scalar* p = parameters.data();
        Scalar* mean = state_.mean.data();
        Scalar* square = state_.square.data();
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
    AdamState<Scalar> state_;
};

}  // namespace taylorcal::emulator
