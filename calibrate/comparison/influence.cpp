#include "calibrate/comparison/influence.hpp"

#include "calibrate/likelihood/errors_of_shot.hpp"
#include "calibrate/likelihood/shot_likelihood.hpp"

#include <cmath>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

/// Weights proportional to 1/L of the shot at each draw with that draw's spread.
Eigen::VectorXd weights_without(const ComparisonInputs& inputs,
                                const ShotComparison& shot) {
    Datum own_columns = *shot.datum;
    for (std::size_t i = 0; i < own_columns.columns.size(); ++i)
        own_columns.columns[i] = static_cast<Eigen::Index>(i);
    const ShotLikelihood likelihood(own_columns, shot.fixed_covariance, inputs.levels);
    Eigen::VectorXd logs(shot.draws.rows());
    std::vector<double> log_likelihood(inputs.levels.values.size());
    for (Eigen::Index k = 0; k < logs.size(); ++k) {
        std::fill(log_likelihood.begin(), log_likelihood.end(), 0.0);
        likelihood.add(shot.draws.row(k), log_likelihood.data());
        logs(k) = -log_likelihood[inputs.posterior.levels[static_cast<std::size_t>(k)]];
    }
    const Eigen::VectorXd weights = (logs.array() - logs.maxCoeff()).exp();
    return weights / weights.sum();
}

Influence influence_of(const ComparisonInputs& inputs, const ShotComparison& shot,
                       double spread) {
    const Eigen::VectorXd weights = weights_without(inputs, shot);
    Influence influence;
    influence.id = shot.datum->shot.id;
    influence.n = shot.datum->columns.size();
    influence.effective_draws = 1 / weights.squaredNorm();
    const RowMatrix& units = inputs.posterior.units;
    const std::vector<std::string> names = inputs.space.names();
    for (Eigen::Index j = 0; j < units.cols(); ++j) {
        const double mean = units.col(j).mean();
        const double sd = std::sqrt((units.col(j).array() - mean).square().mean());
        const double shift = std::abs(units.col(j).dot(weights) - mean) / sd;
        if (!(shift > influence.largest_shift_sd)) continue;
        influence.largest_shift_sd = shift;
        influence.parameter = names[static_cast<std::size_t>(j)];
    }
    const Eigen::RowVectorXd mean = weights.transpose() * shot.draws;
    const RowMatrix centred = shot.draws.rowwise() - mean;
    const Eigen::MatrixXd covariance =
        with_spread(shot.fixed_covariance, *shot.datum, spread) +
        Eigen::MatrixXd(centred.transpose() * weights.asDiagonal() * centred);
    const Eigen::VectorXd residual = shot.datum->measured_mm - mean.transpose();
    influence.chi2_left_out = residual.dot(covariance.ldlt().solve(residual));
    return influence;
}

}  // namespace

std::vector<Influence> leave_one_out(const ComparisonInputs& inputs,
                                     const std::vector<ShotComparison>& shots) {
    const double spread = inputs.levels.values[inputs.posterior.maxima_levels.front()];
    std::vector<Influence> all;
    for (const ShotComparison& shot : shots)
        if (shot.datum->shot.use == Use::calibrate)
            all.push_back(influence_of(inputs, shot, spread));
    return all;
}

}  // namespace taylorcal::calibrate
