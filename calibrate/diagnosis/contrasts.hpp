#pragma once

#include "calibrate/diagnosis/maximum_test.hpp"
#include "calibrate/diagnosis/problem.hpp"
#include "calibrate/diagnosis/projector.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A pattern of misfit to look for, as a change of the measured numbers.
struct Contrast {
    std::string shape;
    std::string size;  ///< empty for a parameter
    std::string what;  ///< "mean", "slope", or the parameter that drifts
    Eigen::VectorXd direction;
    double z = 0;       ///< of the projected residual, unit normal under the null
    double p = 1;       ///< family-wise
    double amount = 0;  ///< the misfit itself, in units of `direction`
};

/// For each shape x size: all numbers too large by 1 % ("mean"; two and more data), and
/// by an amount rising from -1 % to 1 % with velocity ("slope"; four and more). [mm]
std::vector<Contrast> battery_contrasts(const DiagnosisProblem& problem);

/// For each shape x size a mean, a slope and a curvature in velocity of 1 % [mm], a
/// column each, as far as its data can tell them apart.
Eigen::MatrixXd smooth_patterns(const DiagnosisProblem& problem);

/// For each parameter x shape: whitened weights that give the shift of the parameter when
/// the shape is fitted alone. Empty with one shape.
std::vector<Contrast> drift_contrasts(const DiagnosisProblem& problem,
                                      const Eigen::MatrixXd& slope);

/// Fills z, p and amount from whitened directions and the whitened residual, the most
/// telling first; contrasts that the parameters absorb are dropped. Returns the family's
/// p.
double test_contrasts(std::vector<Contrast>& contrasts, const Projector& project,
                      const Eigen::VectorXd& residual, const NormalTable& table);

}  // namespace taylorcal::calibrate
