#pragma once

#include "calibrate/diagnosis/refit.hpp"

#include <vector>

namespace taylorcal::calibrate {

/// Which group each datum belongs to, for leaving groups out: its shape; with one shape
/// only, its third by velocity.
std::vector<std::size_t> groups_to_leave_out(const DiagnosisProblem& problem);

/// Sum over the groups g of ln p(y_g | all other data), the model linearised at its fit;
/// parameters and amplitudes with Gaussian priors of the spread of their true ones.
/// `covariance`: of all errors of this fit [mm^2].
double leave_out_score(const DiagnosisProblem& problem, const Refit& fit,
                       const Eigen::MatrixXd& covariance,
                       const std::vector<std::size_t>& groups);

}  // namespace taylorcal::calibrate
