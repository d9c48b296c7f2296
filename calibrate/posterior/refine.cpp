#include "calibrate/posterior/refine.hpp"

#include "calibrate/posterior/descent.hpp"
#include "calibrate/posterior/simplex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>

namespace taylorcal::calibrate {
namespace {

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

/// ln of the average of the likelihood over the lots' own parameters, but for a constant:
/// the height at their best and the widths there, none wider than its prior.
double log_average(const Descent& own, const ParameterSpace& space) {
    const auto width = static_cast<Eigen::Index>(space.per_lot_count());
    double sum = -0.5 * own.residual.squaredNorm();
    for (std::size_t lot = 0; lot < space.lot_count(); ++lot) {
        const Eigen::MatrixXd slope =
            own.slope.middleCols(static_cast<Eigen::Index>(lot) * width, width);
        const Eigen::MatrixXd precision =
            slope.transpose() * slope / (2 * std::numbers::pi);
        sum -= 0.5 * std::log(std::max(precision.determinant(), 1.0));
    }
    return sum;
}

Eigen::VectorXd climb(const LotLikelihood& likelihood, const Eigen::VectorXd& start,
                      const Eigen::VectorXd& size, std::size_t level) {
    const ParameterSpace& space = likelihood.space();
    const auto shared = static_cast<Eigen::Index>(space.shared_count());
    if (shared == 0 || space.per_lot_count() == 0)
        return descend(likelihood, start, level, 0).unit;
    Eigen::VectorXd point = start;
    const auto with_own = [&](const Eigen::VectorXd& at) {
        point.head(shared) = at;
        const Descent own = descend(likelihood, point, level, shared);
        point = own.unit;
        return own;
    };
    const Eigen::VectorXd best = climb_simplex(
        [&](const Eigen::VectorXd& at) { return log_average(with_own(at), space); },
        start.head(shared), size.head(shared));
    return with_own(best).unit;
}

}  // namespace

RefinedPoint refine(const LotLikelihood& likelihood, const Eigen::VectorXd& start,
                    const Eigen::VectorXd& size) {
    RefinedPoint point{start.cwiseMax(0.0).cwiseMin(1.0), 0};
    constexpr int turns = 3;
    for (int turn = 0; turn < turns; ++turn) {
        const std::size_t level = best_level(likelihood, point.unit);
        if (turn > 0 && level == point.level) break;
        point.level = level;
        point.unit = climb(likelihood, point.unit, size, level);
    }
    return point;
}

}  // namespace taylorcal::calibrate
