#pragma once

#include "calibrate/measurements/shot.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A shot that would tell explanations apart.
struct NextExperiment {
    Shot shot;  ///< shape, lot, velocity, geometry and temperature only
    double separation = 0;
    std::string words;
};

/// What one explanation predicts for a shot.
struct Prediction {
    double weight = 1;     ///< its share of the evidence, pi
    Eigen::VectorXd mean;  ///< sizes [mm]
};

/// Sum over pairs of pi_k pi_l |C^-1/2 (mu_k - mu_l)|^2, C the covariance of one such
/// measurement with what the parameters leave open.
double separation(const std::vector<Prediction>& explanations,
                  const Eigen::MatrixXd& covariance);

}  // namespace taylorcal::calibrate
