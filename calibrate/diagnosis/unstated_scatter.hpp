#pragma once

#include "calibrate/diagnosis/problem.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// How much more than its errors say a size scatters from shot to shot.
struct UnstatedScatter {
    std::string size;
    std::vector<Eigen::Index> data;  ///< numbers of the problem that scatter so
    double relative_sd = 0;          ///< of the size, beyond what its errors say
    double stated_sd = 0;            ///< what the errors say, root mean square, relative
    double freedom = 0;              ///< degrees of freedom that it is known with
};

/// What missing physics leaves is smooth in velocity, what errors leave is not. For each
/// size the residual [mm] of each shape is freed of a parabola in velocity, of a straight
/// line in each other input and of each lot's mean; the likelihood of the rest, all
/// shapes together, says how much scatter the covariance lacks. A number that stands
/// wildly apart from the others (p < 0.01) is not scatter. Sizes that lack none, or have
/// too few numbers to say, are left out.
std::vector<UnstatedScatter> unstated_scatter(const DiagnosisProblem& problem,
                                              const Eigen::VectorXd& residual_mm);

/// Adds it to the problem's covariance, and what it is known with to the freedom.
void count_scatter(const std::vector<UnstatedScatter>& scatters,
                   DiagnosisProblem& problem);

}  // namespace taylorcal::calibrate
