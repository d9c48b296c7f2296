#include "calibrate/diagnosis/whitening.hpp"

#include "common/errors.hpp"

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {

Whitening::Whitening(const Eigen::MatrixXd& covariance) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
    if (cholesky.info() != Eigen::Success)
        throw NumericalError("the covariance of all measured numbers is singular");
    root_ = cholesky.matrixL();
    log_determinant_ = 2 * root_.diagonal().array().log().sum();
}

Eigen::MatrixXd Whitening::operator()(const Eigen::MatrixXd& columns) const {
    return root_.triangularView<Eigen::Lower>().solve(columns);
}

Eigen::MatrixXd Whitening::colour(const Eigen::MatrixXd& columns) const {
    return root_.triangularView<Eigen::Lower>() * columns;
}

}  // namespace taylorcal::calibrate
