#pragma once

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Quantiles of weighted numbers: the value at which the cumulated weight, counted to the
/// middle of each number's own, reaches the share (linear in between).
class WeightedQuantile {
  public:
    WeightedQuantile(const Eigen::VectorXd& values, const Eigen::VectorXd& weights);
    /// Equal weights.
    explicit WeightedQuantile(const Eigen::VectorXd& values);
    double operator()(double share) const;

  private:
    std::vector<double> values_;
    std::vector<double> shares_;
};

}  // namespace taylorcal::calibrate
