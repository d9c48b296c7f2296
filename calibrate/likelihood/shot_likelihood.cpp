#include "calibrate/likelihood/shot_likelihood.hpp"

#include "calibrate/likelihood/errors_of_shot.hpp"
#include "common/errors.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <fmt/core.h>

namespace taylorcal::calibrate {

ShotLikelihood::ShotLikelihood(const Datum& datum, const Eigen::MatrixXd& fixed,
                               const SpreadLevels& levels)
    : measured_(datum.measured_mm), columns_(datum.columns) {
    const Eigen::Index n = measured_.size();
    if (n > max_sizes)
        throw NumericalError("more sizes a shot than the likelihood holds");
    for (const double spread : levels.values) {
        const Eigen::LLT<Eigen::MatrixXd> cholesky(with_spread(fixed, datum, spread));
        if (cholesky.info() != Eigen::Success)
            throw NumericalError(fmt::format(
                "the error covariance of shot {} is singular", datum.shot.id));
        const Eigen::MatrixXd root = cholesky.matrixL();
        const Eigen::MatrixXd inverse =
            root.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(n, n));
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j <= i; ++j) inverse_roots_.push_back(inverse(i, j));
        const double log_det = 2 * root.diagonal().array().log().sum();
        log_norms_.push_back(
            -0.5 * (log_det + static_cast<double>(n) * std::log(2 * std::numbers::pi)));
    }
}

Eigen::VectorXd ShotLikelihood::whitened(const Eigen::VectorXd& predicted,
                                         std::size_t level) const {
    const Eigen::Index n = measured_.size();
    const double* root =
        inverse_roots_.data() + static_cast<std::size_t>(n * (n + 1) / 2) * level;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j)
            result(i) += *root++ * (measured_(j) -
                                    predicted(columns_[static_cast<std::size_t>(j)]));
    return result;
}

Eigen::MatrixXd ShotLikelihood::inverse_root(std::size_t level) const {
    const Eigen::Index n = measured_.size();
    const double* entry =
        inverse_roots_.data() + static_cast<std::size_t>(n * (n + 1) / 2) * level;
    Eigen::MatrixXd root = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j) root(i, j) = *entry++;
    return root;
}

}  // namespace taylorcal::calibrate
