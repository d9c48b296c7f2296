#pragma once

#include "calibrate/diagnosis/problem.hpp"
#include "calibrate/diagnosis/whitening.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// The model with some candidates switched on, at its best parameters and amplitudes.
struct Refit {
    std::vector<std::size_t> effects;
    Eigen::VectorXd unit;          ///< of the calibrated parameters
    Eigen::VectorXd amplitudes;    ///< of `effects`
    Eigen::VectorXd residual;      ///< whitened
    Eigen::MatrixXd slope;         ///< of whitened predictions to the unit coordinates
    Eigen::MatrixXd effect_slope;  ///< and to amplitudes counted in typical ones

    double chi2() const { return residual.squaredNorm(); }
    /// Both slopes side by side.
    Eigen::MatrixXd all_slopes() const;
};

/// What paired runs of candidate `k` span, its amplitude within its physical range.
RunRange range_of(const DiagnosisProblem& problem, std::size_t k);

/// Whitened predictions of rows of (unit, amplitudes), a row each.
RowMatrix whitened_predictions(const DiagnosisProblem& problem, const Whitening& whiten,
                               const std::vector<std::size_t>& effects,
                               const RowMatrix& units, const RowMatrix& amplitudes);

/// Least squares by Levenberg-Marquardt from `unit` and `amplitudes`: within the unit
/// cube, and with effects within what their paired runs span.
Refit refit(const DiagnosisProblem& problem, const Whitening& whiten,
            const std::vector<std::size_t>& effects, const Eigen::VectorXd& unit,
            const Eigen::VectorXd& amplitudes);

/// The same over the parameters alone, the amplitudes held; `effect_slope` stays empty.
Refit refit_parameters(const DiagnosisProblem& problem, const Whitening& whiten,
                       const std::vector<std::size_t>& effects,
                       const Eigen::VectorXd& unit, const Eigen::VectorXd& amplitudes);

/// A step of the damped normal equations that stays within bounds: coordinates pressed
/// against a bound stay there.
Eigen::VectorXd bounded_step(const Eigen::MatrixXd& normal,
                             const Eigen::VectorXd& downhill, const Eigen::VectorXd& at,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                             double damping);

}  // namespace taylorcal::calibrate
