#include "calibrate/posterior/refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

constexpr double difference_step = 1e-3;  // of the prior's width
constexpr int most_steps = 60;

/// The level that, with its prior density, suits a point best.
std::size_t best_level(const LotLikelihood& likelihood, const Eigen::VectorXd& unit) {
    const SpreadLevels& levels = likelihood.levels();
    if (!levels.is_free()) return 0;
    const RowMatrix log_likelihood = likelihood.log_likelihood(unit.transpose());
    std::size_t best = 0;
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < levels.values.size(); ++g) {
        const double density = levels.log_mass[g] -
                               std::log(levels.edges[g + 1] - levels.edges[g]) +
                               log_likelihood(0, static_cast<Eigen::Index>(g));
        if (density <= highest) continue;
        highest = density;
        best = g;
    }
    return best;
}

/// Jacobian of the whitened residuals by differences that stay inside the cube.
Eigen::MatrixXd jacobian(const LotLikelihood& likelihood, const Eigen::VectorXd& unit,
                         std::size_t level) {
    const Eigen::Index p = unit.size();
    RowMatrix points(2 * p, p);
    for (Eigen::Index j = 0; j < p; ++j) {
        points.row(2 * j) = points.row(2 * j + 1) = unit.transpose();
        points(2 * j, j) = std::min(unit(j) + difference_step, 1.0);
        points(2 * j + 1, j) = std::max(unit(j) - difference_step, 0.0);
    }
    const RowMatrix residuals = likelihood.whitened(points, level);
    Eigen::MatrixXd slope(residuals.cols(), p);
    for (Eigen::Index j = 0; j < p; ++j)
        slope.col(j) = (residuals.row(2 * j) - residuals.row(2 * j + 1)).transpose() /
                       (points(2 * j, j) - points(2 * j + 1, j));
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

Eigen::VectorXd descend(const LotLikelihood& likelihood, Eigen::VectorXd unit,
                        std::size_t level) {
    const auto residual_at = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
        return likelihood.whitened(u.transpose(), level).row(0).transpose();
    };
    Eigen::VectorXd residual = residual_at(unit);
    double damping = 1e-3;
    for (int i = 0; i < most_steps && damping < 1e8; ++i) {
        const Eigen::MatrixXd slope = jacobian(likelihood, unit, level);
        double gain = 0, length = 0;
        while (gain <= 0 && damping < 1e8) {
            const Eigen::VectorXd step = damped_step(slope, residual, unit, damping);
            const Eigen::VectorXd tried = residual_at(unit + step);
            gain = residual.squaredNorm() - tried.squaredNorm();
            length = step.lpNorm<Eigen::Infinity>();
            damping = gain > 0 ? std::max(0.2 * damping, 1e-12) : 5 * damping;
            if (gain > 0) {
                unit += step;
                residual = tried;
            }
        }
        if (gain < 1e-6 || length < 1e-7) break;
    }
    return unit;
}

}  // namespace

RefinedPoint refine(const LotLikelihood& likelihood, const Eigen::VectorXd& start) {
    RefinedPoint point{start.cwiseMax(0.0).cwiseMin(1.0), 0};
    constexpr int turns = 4;
    for (int turn = 0; turn < turns; ++turn) {
        const std::size_t level = best_level(likelihood, point.unit);
        if (turn > 0 && level == point.level) break;
        point.level = level;
        point.unit = descend(likelihood, point.unit, level);
    }
    return point;
}

}  // namespace taylorcal::calibrate
