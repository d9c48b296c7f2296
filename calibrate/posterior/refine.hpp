#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A point of the unit cube at one level of the relative spread.
struct RefinedPoint {
    Eigen::VectorXd unit;
    std::size_t level = 0;
};

/// Climbs from a draw to the local maximum of the posterior density on the network:
/// Levenberg-Marquardt on the whitened residuals, kept inside the unit cube, in turn with
/// the best level of the spread.
RefinedPoint refine(const LotLikelihood& likelihood, const Eigen::VectorXd& start);

}  // namespace taylorcal::calibrate
