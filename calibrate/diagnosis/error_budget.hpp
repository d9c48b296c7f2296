#pragma once

#include "calibrate/diagnosis/corrected_model.hpp"

#include <string>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Covariances [mm^2] of all fitted numbers, by cause.
struct ErrorBudget {
    Eigen::MatrixXd measurement;  ///< of the sizes, independent
    Eigen::MatrixXd velocity;     ///< moves all sizes of a shot together
    Eigen::MatrixXd scatter;  ///< of paired runs about their fit: grains, and its misfit
    Eigen::MatrixXd correction;          ///< of delta's coefficients: common to a shape
    Eigen::MatrixXd resolution;          ///< of the discretisation: common to a shape
    Eigen::VectorXd freedom_of_scatter;  ///< points less terms of each number's fit

    Eigen::MatrixXd total() const {
        return measurement + velocity + scatter + correction + resolution;
    }
    /// Welch's and Satterthwaite's degrees of freedom of each number's variance, of which
    /// a part was estimated from few runs.
    Eigen::VectorXd freedom() const;
    /// Root mean square of each, in per cent of the sizes.
    std::string words(const CorrectedModel& model) const;
};

/// At the model's reference point.
ErrorBudget error_budget(const CorrectedPredictor& predictor, const CorrectedModel& model,
                         const Settings& settings);

/// Covariance of the error of candidate k's fitted signature at amplitude 1: its points'
/// scatter about the polynomial, alike for all sizes of a shot, and the uncertainty of
/// the coefficients, common to a shape.
Eigen::MatrixXd effect_errors(const CorrectedPredictor& predictor,
                              const CorrectedModel& model, std::size_t k);

/// Covariance of one shot of any kind: measurement (relative sd by fitted size),
/// velocity, scatter and the resolution's error.
Eigen::MatrixXd covariance_of_new_shot(const CorrectedPredictor& predictor,
                                       const Settings& settings, const Shot& shot,
                                       const RowMatrix& parameters,
                                       const Eigen::VectorXd& relative_sd);

}  // namespace taylorcal::calibrate
