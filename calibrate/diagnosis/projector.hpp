#pragma once

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// P: removes from a whitened vector what the columns of J (and so a change of the
/// parameters) can imitate.
class Projector {
  public:
    /// A direction of the parameters that moves all data together by less than half a
    /// standard error over its whole prior absorbs nothing and is not counted.
    explicit Projector(const Eigen::MatrixXd& slope);
    Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const {
        return columns - basis_ * (basis_.transpose() * columns);
    }
    Eigen::Index rank() const { return basis_.cols(); }

  private:
    Eigen::MatrixXd basis_;  // orthonormal columns of span(J)
};

}  // namespace taylorcal::calibrate
