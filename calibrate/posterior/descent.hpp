#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// The end of a descent: a point of the unit cube, its whitened residuals and their slope
/// to the coordinates that were free.
struct Descent {
    Eigen::VectorXd unit;
    Eigen::VectorXd residual;
    Eigen::MatrixXd slope;
};

/// Least squares of the whitened residuals at one level of the spread by
/// Levenberg-Marquardt, inside the unit cube. Coordinates before `first` stay as they
/// are.
Descent descend(const LotLikelihood& likelihood, const Eigen::VectorXd& start,
                std::size_t level, Eigen::Index first);

}  // namespace taylorcal::calibrate
