#pragma once

#include "calibrate/measurements/data_set.hpp"
#include "calibrate/posterior/posterior_file.hpp"
#include "calibrate/prediction/predictor.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// One shot against the model; vectors run over its fitted sizes, lengths in mm.
struct ShotComparison {
    const Datum* datum = nullptr;
    Eigen::VectorXd predicted;         ///< at the best maximum
    Eigen::VectorXd predictive_mean;   ///< over the posterior's draws
    Eigen::VectorXd predictive_lower;  ///< 95 % band of the model
    Eigen::VectorXd predictive_upper;
    Eigen::VectorXd predictive_sd;     ///< of a measurement: parameters, C and spread
    Eigen::VectorXd residual;          ///< measured - predicted
    Eigen::VectorXd standardised;      ///< residual / sqrt(C_ii)
    Eigen::VectorXd whitened;          ///< L^-1 residual, C = L L^T
    RowMatrix draws;                   ///< prediction for every draw
    Eigen::MatrixXd fixed_covariance;  ///< C without the spread [mm^2]
    Eigen::MatrixXd covariance;        ///< the C of `whitened` [mm^2]
};

/// What comparing works on.
struct ComparisonInputs {
    const Settings& settings;
    const DataSet& set;
    const ParameterSpace& space;
    const SpreadLevels& levels;
    const Predictor& predictor;
    const StoredPosterior& posterior;
};

/// Sizes of the datum (columns) for rows of plain parameters.
RowMatrix predict_datum(const Predictor& predictor, const Datum& datum,
                        const RowMatrix& parameters);

/// Compares every shot that is fitted or held back. Residuals are whitened with the
/// unexplained spread set to zero, for a fitted spread would absorb what is missing; in
/// the paper's form with its one sigma at the best maximum.
std::vector<ShotComparison> compare_shots(const ComparisonInputs& inputs);

}  // namespace taylorcal::calibrate
