#pragma once

#include "calibrate/measurements/data_set.hpp"
#include "calibrate/prediction/predictor.hpp"
#include "calibrate/settings/settings.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// The part of the network's error that two shots of one metal have in common: a smooth
/// network that is off at one velocity is off at the next one, too, and somewhat for the
/// other shapes.
double common_share(const Predictor& predictor, const Shot& a, const Shot& b);

/// Covariance [mm^2], without the relative spread, of all sizes of shots of one lot, shot
/// by shot: `fixed_covariance` of each, and between two shots
/// common_share E_a^(1/2) E_b^(1/2) of the network's. `parameters`: plain, of the lot.
Eigen::MatrixXd lot_covariance(const Settings& settings, const Predictor& predictor,
                               const std::vector<const Datum*>& shots,
                               const Eigen::VectorXd& parameters);

}  // namespace taylorcal::calibrate
