#pragma once

#include "calibrate/measurements/data_set.hpp"
#include "calibrate/prediction/predictor.hpp"
#include "calibrate/settings/settings.hpp"

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Standard deviation of a shot's velocity [m/s]: the table's, else the settings' share.
double velocity_sd(const Settings& settings, const Shot& shot);

/// df/dv [mm/(m/s)] of the datum's sizes by a central difference of 1 % of the velocity,
/// one-sided at the end of the predictor's range. `parameters`: plain, of the shot's lot.
Eigen::VectorXd velocity_slope(const Predictor& predictor, const Datum& datum,
                               const Eigen::VectorXd& parameters);

/// The part of the error covariance [mm^2] of a shot that does not depend on the relative
/// spread: C = diag(sd^2) + (df/dv)(df/dv)^T sd_v^2 + E_shape. Zero in the paper's form.
Eigen::MatrixXd fixed_covariance(const Settings& settings, const Predictor& predictor,
                                 const Datum& datum, const Eigen::VectorXd& parameters);

/// Adds the relative spread: C + spread^2 diag(y^2), y the sizes that it refers to.
Eigen::MatrixXd with_spread(const Eigen::MatrixXd& fixed, const Datum& datum,
                            double spread);

}  // namespace taylorcal::calibrate
