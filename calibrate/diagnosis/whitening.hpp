#pragma once

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// C = L L^T of all errors; whitened vectors L^-1 x have unit covariance.
class Whitening {
  public:
    /// NumericalError unless the covariance is positive definite.
    explicit Whitening(const Eigen::MatrixXd& covariance);
    /// L^-1 x for the columns of x.
    Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const;
    /// L x, the way back.
    Eigen::MatrixXd colour(const Eigen::MatrixXd& columns) const;
    double log_determinant() const { return log_determinant_; }

  private:
    Eigen::MatrixXd root_;
    double log_determinant_;
};

}  // namespace taylorcal::calibrate
