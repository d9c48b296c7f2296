#include "calibrate/posterior/descent.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

constexpr double difference_step = 1e-3;  // of the prior's width
constexpr int most_steps = 60;
constexpr double most_damping = 1e8;

/// Jacobian of the whitened residuals to the coordinates from `first` on, by differences
/// that stay inside the cube.
Eigen::MatrixXd jacobian(const LotLikelihood& likelihood, const Eigen::VectorXd& unit,
                         std::size_t level, Eigen::Index first) {
    const Eigen::Index p = unit.size() - first;
    RowMatrix points(2 * p, unit.size());
    for (Eigen::Index j = 0; j < p; ++j) {
        points.row(2 * j) = points.row(2 * j + 1) = unit.transpose();
        points(2 * j, first + j) = std::min(unit(first + j) + difference_step, 1.0);
        points(2 * j + 1, first + j) = std::max(unit(first + j) - difference_step, 0.0);
    }
    const RowMatrix residuals = likelihood.whitened(points, level);
    Eigen::MatrixXd slope(residuals.cols(), p);
    for (Eigen::Index j = 0; j < p; ++j)
        slope.col(j) = (residuals.row(2 * j) - residuals.row(2 * j + 1)).transpose() /
                       (points(2 * j, first + j) - points(2 * j + 1, first + j));
    return slope;
}

/// A step of the damped normal equations; parameters pressed against a wall stay there.
Eigen::VectorXd damped_step(const Eigen::MatrixXd& slope, const Eigen::VectorXd& residual,
                            const Eigen::VectorXd& unit, double damping) {
    const Eigen::VectorXd downhill = -slope.transpose() * residual;
    Eigen::MatrixXd normal = slope.transpose() * slope;
    normal.diagonal().array() += damping * normal.diagonal().array() + 1e-12;
    for (Eigen::Index j = 0; j < unit.size(); ++j) {
        const bool pressed =
            (unit(j) <= 0 && downhill(j) < 0) || (unit(j) >= 1 && downhill(j) > 0);
        if (!pressed) continue;
        normal.row(j).setZero();
        normal.col(j).setZero();
        normal(j, j) = 1;
    }
    Eigen::VectorXd step = normal.ldlt().solve(downhill);
    for (Eigen::Index j = 0; j < unit.size(); ++j)
        step(j) = std::clamp(unit(j) + step(j), 0.0, 1.0) - unit(j);
    return step;
}

}  // namespace

Descent descend(const LotLikelihood& likelihood, const Eigen::VectorXd& start,
                std::size_t level, Eigen::Index first) {
    const auto residual_at = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
        return likelihood.whitened(u.transpose(), level).row(0).transpose();
    };
    Descent now{start, residual_at(start), {}};
    double damping = 1e-3;
    for (int i = 0; i < most_steps; ++i) {
        now.slope = jacobian(likelihood, now.unit, level, first);
        double gain = 0, length = 0;
        while (gain <= 0 && damping < most_damping) {
            const Eigen::VectorXd free = now.unit.tail(now.unit.size() - first);
            const Eigen::VectorXd step =
                damped_step(now.slope, now.residual, free, damping);
            Eigen::VectorXd unit = now.unit;
            unit.tail(step.size()) += step;
            const Eigen::VectorXd residual = residual_at(unit);
            gain = now.residual.squaredNorm() - residual.squaredNorm();
            length = step.lpNorm<Eigen::Infinity>();
            damping = gain > 0 ? std::max(0.2 * damping, 1e-12) : 5 * damping;
            if (gain > 0) now = {unit, residual, now.slope};
        }
        if (gain < 1e-4 || length < 1e-6) break;
    }
    return now;
}

}  // namespace taylorcal::calibrate
