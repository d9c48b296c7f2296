#pragma once

#include <span>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// ln Z gained by a further part of the errors, sum_j a_j columns_j with a_j ~ N(0, s^2),
/// averaged over the scales s: exact for a linear model whose parameters are projected
/// out. `columns` (one a pattern) and `residual` whitened and projected.
double gain_of_extra_error(const Eigen::MatrixXd& columns,
                           const Eigen::VectorXd& residual,
                           std::span<const double> scales);

}  // namespace taylorcal::calibrate
