#pragma once

#include "calibrate/comparison/shot_comparison.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// How the errors of all measured sizes, shot by shot, go together: a shot's sizes share
/// its velocity, shots of a lot share the network's error where the likelihood says so.
struct JointErrors {
    Eigen::MatrixXd standardised;  ///< covariance of the shots' `standardised`
    Eigen::MatrixXd whitened;      ///< of their `whitened`: identity within a shot
};

JointErrors joint_errors(const ComparisonInputs& inputs,
                         const std::vector<ShotComparison>& shots);

}  // namespace taylorcal::calibrate
