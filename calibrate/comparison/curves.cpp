#include "calibrate/comparison/curves.hpp"

#include "calibrate/posterior/thinned.hpp"
#include "calibrate/posterior/weighted_quantile.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace taylorcal::calibrate {
namespace {

constexpr int points_of_curve = 25;
constexpr Eigen::Index draws_of_band = 400;

bool same_geometry(const Shot& a, const Shot& b) {
    return a.lot == b.lot && a.shape == b.shape &&
           a.initial_diameter_mm == b.initial_diameter_mm &&
           a.initial_length_mm == b.initial_length_mm;
}

struct Range {
    double lower = std::numeric_limits<double>::infinity();
    double upper = 0;
};

std::map<std::size_t, Range> velocity_ranges(const ComparisonInputs& inputs) {
    std::map<std::size_t, Range> ranges;
    for (const Datum& datum : inputs.set.data) {
        Range& range = ranges[datum.lot];
        range.lower = std::min(range.lower, 0.95 * datum.shot.velocity_m_s);
        range.upper = std::max(range.upper, 1.05 * datum.shot.velocity_m_s);
    }
    for (auto& [lot, range] : ranges) {
        range.lower = std::max(range.lower, inputs.predictor.lowest_velocity_m_s());
        range.upper = std::min(range.upper, inputs.predictor.highest_velocity_m_s());
    }
    return ranges;
}

/// Sizes that any shot of the geometry has.
std::vector<Eigen::Index> sizes_of(const DataSet& set, const Shot& geometry) {
    std::vector<Eigen::Index> columns;
    for (const Datum& datum : set.data)
        if (same_geometry(datum.shot, geometry))
            columns.insert(columns.end(), datum.columns.begin(), datum.columns.end());
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
}

void add_curves(std::vector<Curve>& curves, const ComparisonInputs& inputs,
                const Datum& datum, const Range& range) {
    Shot shot = datum.shot;
    const std::vector<Eigen::Index> columns = sizes_of(inputs.set, shot);
    const std::size_t first = curves.size();
    for (const Eigen::Index column : columns) {
        Curve curve{shot.lot, shot.shape,
                    inputs.set.sizes[static_cast<std::size_t>(column)]};
        curve.initial_diameter_mm = shot.initial_diameter_mm;
        curve.initial_length_mm = shot.initial_length_mm;
        curve.initial_temperature_K = shot.initial_temperature_K;
        curves.push_back(curve);
    }
    const RowMatrix of_draws = inputs.space.lot_parameters(
        thinned(inputs.posterior.units, draws_of_band), datum.lot);
    const RowMatrix of_best =
        inputs.space.lot_parameters(inputs.posterior.maxima_units.topRows(1), datum.lot);
    for (int i = 0; i < points_of_curve; ++i) {
        const double t = static_cast<double>(i) / (points_of_curve - 1);
        shot.velocity_m_s = range.lower + t * (range.upper - range.lower);
        const RowMatrix draws = inputs.predictor.predict(shot, of_draws);
        const RowMatrix best = inputs.predictor.predict(shot, of_best);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            Curve& curve = curves[first + c];
            const Eigen::VectorXd values = draws.col(columns[c]);
            const WeightedQuantile quantile(values);
            curve.velocity_m_s.push_back(shot.velocity_m_s);
            curve.predicted.push_back(best(0, columns[c]));
            curve.mean.push_back(values.mean());
            curve.lower.push_back(quantile(0.025));
            curve.upper.push_back(quantile(0.975));
        }
    }
}

}  // namespace

std::vector<Curve> predict_curves(const ComparisonInputs& inputs) {
    const auto ranges = velocity_ranges(inputs);
    std::vector<Curve> curves;
    std::vector<const Datum*> done;
    for (const Datum& datum : inputs.set.data) {
        const bool known = std::any_of(done.begin(), done.end(), [&](const Datum* other) {
            return same_geometry(other->shot, datum.shot);
        });
        if (known) continue;
        done.push_back(&datum);
        add_curves(curves, inputs, datum, ranges.at(datum.lot));
    }
    return curves;
}

}  // namespace taylorcal::calibrate
