#include "calibrate/comparison/shot_comparison.hpp"

#include "calibrate/likelihood/errors_of_shot.hpp"
#include "calibrate/posterior/weighted_quantile.hpp"

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

/// Mean of the squared relative spread over the draws.
double mean_square_spread(const ComparisonInputs& inputs) {
    double sum = 0;
    for (const std::size_t level : inputs.posterior.levels)
        sum += inputs.levels.values[level] * inputs.levels.values[level];
    return sum / static_cast<double>(inputs.posterior.levels.size());
}

void add_band(ShotComparison& shot, double spread_squared) {
    const Eigen::Index n = shot.draws.cols();
    shot.predictive_mean = shot.draws.colwise().mean().transpose();
    shot.predictive_lower.resize(n);
    shot.predictive_upper.resize(n);
    shot.predictive_sd.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const WeightedQuantile quantile(shot.draws.col(i));
        shot.predictive_lower(i) = quantile(0.025);
        shot.predictive_upper(i) = quantile(0.975);
        const double of_model =
            (shot.draws.col(i).array() - shot.predictive_mean(i)).square().mean();
        const double scale = shot.datum->scale_mm(i);
        shot.predictive_sd(i) = std::sqrt(of_model + shot.fixed_covariance(i, i) +
                                          spread_squared * scale * scale);
    }
}

ShotComparison compare_shot(const ComparisonInputs& inputs, const Datum& datum) {
    const StoredPosterior& posterior = inputs.posterior;
    const auto parameters = [&](const RowMatrix& units) {
        return inputs.space.lot_parameters(units, datum.lot);
    };
    ShotComparison shot;
    shot.datum = &datum;
    shot.predicted = predict_datum(inputs.predictor, datum,
                                   parameters(posterior.maxima_units.topRows(1)))
                         .row(0)
                         .transpose();
    shot.draws = predict_datum(inputs.predictor, datum, parameters(posterior.units));
    shot.fixed_covariance =
        fixed_covariance(inputs.settings, inputs.predictor, datum,
                         parameters(posterior.reference.transpose()).row(0).transpose());
    const bool paper = inputs.settings.likelihood == LikelihoodForm::paper;
    const double spread =
        paper ? inputs.levels.values[posterior.maxima_levels.front()] : 0.0;
    shot.covariance = with_spread(shot.fixed_covariance, datum, spread);
    shot.residual = datum.measured_mm - shot.predicted;
    shot.standardised =
        shot.residual.cwiseQuotient(shot.covariance.diagonal().cwiseSqrt());
    shot.whitened =
        Eigen::LLT<Eigen::MatrixXd>(shot.covariance).matrixL().solve(shot.residual);
    add_band(shot, mean_square_spread(inputs));
    return shot;
}

}  // namespace

RowMatrix predict_datum(const Predictor& predictor, const Datum& datum,
                        const RowMatrix& parameters) {
    const RowMatrix all = predictor.predict(datum.shot, parameters);
    RowMatrix chosen(all.rows(), static_cast<Eigen::Index>(datum.columns.size()));
    for (std::size_t i = 0; i < datum.columns.size(); ++i)
        chosen.col(static_cast<Eigen::Index>(i)) = all.col(datum.columns[i]);
    return chosen;
}

std::vector<ShotComparison> compare_shots(const ComparisonInputs& inputs) {
    std::vector<ShotComparison> shots;
    for (const Datum& datum : inputs.set.data)
        shots.push_back(compare_shot(inputs, datum));
    return shots;
}

}  // namespace taylorcal::calibrate
