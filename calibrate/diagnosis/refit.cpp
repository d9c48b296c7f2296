#include "calibrate/diagnosis/refit.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

constexpr double unit_step = 2e-3;       // of the prior's width, for slopes
constexpr double amplitude_step = 0.02;  // of the typical amplitude
constexpr int most_steps = 40;
constexpr double most_damping = 1e8;

/// Unit coordinates and amplitudes in one vector, amplitudes by their typical size; or
/// unit coordinates alone, the amplitudes held.
struct Coordinates {
    Eigen::Index parameters = 0;
    Eigen::VectorXd lower, upper, size, step;
    Eigen::VectorXd held;  ///< amplitudes; empty where they are fitted

    Coordinates(const DiagnosisProblem& problem, const std::vector<std::size_t>& effects,
                Eigen::Index p)
        : parameters(p) {
        const Eigen::Index n = p + static_cast<Eigen::Index>(effects.size());
        lower = Eigen::VectorXd::Zero(n);
        upper = size = Eigen::VectorXd::Ones(n);
        step = Eigen::VectorXd::Constant(n, unit_step);
        for (Eigen::Index e = p; e < n; ++e) {
            const std::size_t k = effects[static_cast<std::size_t>(e - p)];
            const RunRange range = range_of(problem, k);
            size(e) = std::abs(problem.candidates[k].typical());
            lower(e) = range.lowest / size(e);
            upper(e) = range.highest / size(e);
            step(e) = amplitude_step;
            keep_parameters(range);
        }
    }
    void keep_parameters(const RunRange& range) {
        lower.head(parameters) = lower.head(parameters).cwiseMax(range.lower);
        upper.head(parameters) = upper.head(parameters).cwiseMin(range.upper);
    }
    RowMatrix predictions(const DiagnosisProblem& problem, const Whitening& whiten,
                          const std::vector<std::size_t>& effects,
                          const RowMatrix& points) const {
        if (held.size() > 0)
            return whitened_predictions(problem, whiten, effects, points,
                                        held.transpose().replicate(points.rows(), 1));
        const Eigen::Index m = points.cols() - parameters;
        return whitened_predictions(problem, whiten, effects, points.leftCols(parameters),
                                    points.rightCols(m) * size.tail(m).asDiagonal());
    }
};

Eigen::MatrixXd slopes(const DiagnosisProblem& problem, const Whitening& whiten,
                       const std::vector<std::size_t>& effects,
                       const Coordinates& coordinates, const Eigen::VectorXd& at) {
    const Eigen::Index n = at.size();
    RowMatrix points(2 * n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        points.row(2 * j) = points.row(2 * j + 1) = at.transpose();
        points(2 * j, j) = std::min(at(j) + coordinates.step(j), coordinates.upper(j));
        points(2 * j + 1, j) =
            std::max(at(j) - coordinates.step(j), coordinates.lower(j));
    }
    const RowMatrix predicted = coordinates.predictions(problem, whiten, effects, points);
    Eigen::MatrixXd slope(predicted.cols(), n);
    for (Eigen::Index j = 0; j < n; ++j)
        slope.col(j) = (predicted.row(2 * j) - predicted.row(2 * j + 1)).transpose() /
                       (points(2 * j, j) - points(2 * j + 1, j));
    return slope;
}

struct Minimum {
    Eigen::VectorXd at, residual;
    Eigen::MatrixXd slope;
};

Minimum minimise(const DiagnosisProblem& problem, const Whitening& whiten,
                 const std::vector<std::size_t>& effects, const Coordinates& coordinates,
                 Eigen::VectorXd at) {
    const Eigen::VectorXd measured = whiten(problem.measured);
    const auto residual_at = [&](const Eigen::VectorXd& point) -> Eigen::VectorXd {
        return measured -
               coordinates.predictions(problem, whiten, effects, point.transpose())
                   .row(0)
                   .transpose();
    };
    at = at.cwiseMax(coordinates.lower).cwiseMin(coordinates.upper);
    Eigen::VectorXd residual = residual_at(at);
    Eigen::MatrixXd slope = slopes(problem, whiten, effects, coordinates, at);
    double damping = 1e-4;
    for (int i = 0; i < most_steps; ++i) {
        const Eigen::MatrixXd normal = slope.transpose() * slope;
        const Eigen::VectorXd downhill = slope.transpose() * residual;
        double gain = 0;
        while (gain <= 0 && damping < most_damping) {
            const Eigen::VectorXd next =
                at + bounded_step(normal, downhill, at, coordinates.lower,
                                  coordinates.upper, damping);
            const Eigen::VectorXd there = residual_at(next);
            gain = residual.squaredNorm() - there.squaredNorm();
            damping = gain > 0 ? std::max(0.1 * damping, 1e-12) : 10 * damping;
            if (gain > 0) {
                at = next;
                residual = there;
            } else if (gain > -1e-6) {
                break;
            }
        }
        if (gain > 0) slope = slopes(problem, whiten, effects, coordinates, at);
        if (gain < 1e-3) break;
    }
    return {at, residual, slope};
}

}  // namespace

RunRange range_of(const DiagnosisProblem& problem, std::size_t k) {
    RunRange range = problem.model.run_range(k);
    range.lowest = std::max(range.lowest, problem.candidates[k].lower());
    range.highest = std::min(range.highest, problem.candidates[k].upper());
    return range;
}

Eigen::MatrixXd Refit::all_slopes() const {
    Eigen::MatrixXd all(slope.rows(), slope.cols() + effect_slope.cols());
    all << slope, effect_slope;
    return all;
}

RowMatrix whitened_predictions(const DiagnosisProblem& problem, const Whitening& whiten,
                               const std::vector<std::size_t>& effects,
                               const RowMatrix& units, const RowMatrix& amplitudes) {
    RowMatrix predicted = problem.model.predict(units);
    for (std::size_t e = 0; e < effects.size(); ++e)
        predicted += problem.model.shift(effects[e], units,
                                         amplitudes.col(static_cast<Eigen::Index>(e)));
    return whiten(predicted.transpose()).transpose();
}

Eigen::VectorXd bounded_step(const Eigen::MatrixXd& normal,
                             const Eigen::VectorXd& downhill, const Eigen::VectorXd& at,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                             double damping) {
    Eigen::MatrixXd damped = normal;
    damped.diagonal().array() += damping * normal.diagonal().array() + 1e-9;
    Eigen::VectorXd right = downhill;
    const auto hold = [&](Eigen::Index j) {
        damped.row(j).setZero();
        damped.col(j).setZero();
        damped(j, j) = 1;
        right(j) = 0;
    };
    for (Eigen::Index j = 0; j < at.size(); ++j)
        if ((at(j) <= lower(j) && downhill(j) < 0) ||
            (at(j) >= upper(j) && downhill(j) > 0))
            hold(j);
    Eigen::VectorXd step = damped.ldlt().solve(right);
    // Whoever would leave is put on the bound, and the others answer to that.
    for (Eigen::Index turn = 0; turn < at.size(); ++turn) {
        bool left = false;
        for (Eigen::Index j = 0; j < at.size(); ++j) {
            const double target = at(j) + step(j);
            const double inside = std::clamp(target, lower(j), upper(j));
            if (inside == target) continue;
            const double moved = inside - at(j);
            right -= damped.col(j) * moved;
            damped.row(j).setZero();
            damped.col(j).setZero();
            damped(j, j) = 1;
            right(j) = moved;
            left = true;
        }
        if (!left) break;
        step = damped.ldlt().solve(right);
    }
    return (at + step).cwiseMax(lower).cwiseMin(upper) - at;
}

Refit refit(const DiagnosisProblem& problem, const Whitening& whiten,
            const std::vector<std::size_t>& effects, const Eigen::VectorXd& unit,
            const Eigen::VectorXd& amplitudes) {
    const Eigen::Index p = unit.size(), m = amplitudes.size();
    const Coordinates coordinates(problem, effects, p);
    Eigen::VectorXd start(p + m);
    start << unit, amplitudes.cwiseQuotient(coordinates.size.tail(m));
    const Minimum least = minimise(problem, whiten, effects, coordinates, start);
    return {effects,
            least.at.head(p),
            least.at.tail(m).cwiseProduct(coordinates.size.tail(m)),
            least.residual,
            least.slope.leftCols(p),
            least.slope.rightCols(m)};
}

Refit refit_parameters(const DiagnosisProblem& problem, const Whitening& whiten,
                       const std::vector<std::size_t>& effects,
                       const Eigen::VectorXd& unit, const Eigen::VectorXd& amplitudes) {
    Coordinates coordinates(problem, {}, unit.size());
    coordinates.held = amplitudes;
    for (const std::size_t k : effects) coordinates.keep_parameters(range_of(problem, k));
    const Minimum least = minimise(problem, whiten, effects, coordinates, unit);
    return {effects,        least.at,    amplitudes,
            least.residual, least.slope, Eigen::MatrixXd()};
}

}  // namespace taylorcal::calibrate
