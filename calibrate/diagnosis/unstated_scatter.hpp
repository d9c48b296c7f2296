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
    double over_stated = 0;  ///< standard deviation beyond the errors, over theirs
    double stated_sd = 0;    ///< theirs, root mean square, over the size
    double freedom = 0;      ///< degrees of freedom that it is known with
};

/// What missing physics leaves is smooth in velocity, what errors leave is not. Of each
/// shape and size the residual [mm] is freed of a parabola in velocity, of a straight
/// line in each other input and of each lot's mean; the likelihood of the rest says how
/// much scatter the covariance lacks, in each size or, where one number for all says as
/// much, in all alike. The wildest number, if it stands apart from the others (p < 0.01),
/// is not scatter. Sizes that lack none are left out.
std::vector<UnstatedScatter> unstated_scatter(const DiagnosisProblem& problem,
                                              const Eigen::VectorXd& residual_mm);

/// Adds it to the problem's covariance, and what it is known with to the freedom.
void count_scatter(const std::vector<UnstatedScatter>& scatters,
                   DiagnosisProblem& problem);

}  // namespace taylorcal::calibrate
