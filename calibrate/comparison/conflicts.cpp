#include "calibrate/comparison/conflicts.hpp"

#include "calibrate/comparison/words.hpp"
#include "common/random.hpp"

#include <cmath>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

constexpr Eigen::Index prior_draws = 4096;
constexpr double far = 3;  // standard errors
constexpr std::uint64_t stream_of_prior = 0xc0f1;

/// Draws of one lot's parameters; all lots may use the same ones.
RowMatrix draw_prior(const ComparisonInputs& inputs) {
    const auto size = static_cast<Eigen::Index>(inputs.space.size());
    RowMatrix units(prior_draws, size);
    for (Eigen::Index j = 0; j < size; ++j) {
        const RandomStream stream(
            inputs.settings.seed,
            stream_of_prior + (static_cast<std::uint64_t>(j) << 16));
        for (Eigen::Index i = 0; i < prior_draws; ++i)
            units(i, j) = stream.uniform(static_cast<std::uint64_t>(i));
    }
    return units;
}

}  // namespace

std::vector<Conflict> find_conflicts(const ComparisonInputs& inputs,
                                     const std::vector<ShotComparison>& shots) {
    const RowMatrix units = draw_prior(inputs);
    std::vector<Conflict> conflicts;
    for (const ShotComparison& shot : shots) {
        const Datum& datum = *shot.datum;
        const RowMatrix predicted = predict_datum(
            inputs.predictor, datum, inputs.space.lot_parameters(units, datum.lot));
        for (Eigen::Index i = 0; i < predicted.cols(); ++i) {
            Eigen::Index nearest = 0;
            const double gap = (predicted.col(i).array() - datum.measured_mm(i))
                                   .abs()
                                   .minCoeff(&nearest);
            const double distance = gap / std::sqrt(shot.covariance(i, i));
            if (distance <= far) continue;
            Conflict conflict{datum.shot.id,
                              inputs.set.sizes[static_cast<std::size_t>(
                                  datum.columns[static_cast<std::size_t>(i)])],
                              datum.measured_mm(i),
                              predicted(nearest, i),
                              distance,
                              ""};
            conflict.words = fmt::format(
                "shot {}: {} measured {:.4g} mm, but no parameters in their ranges come "
                "nearer than {:.4g} mm ({:.1f} standard errors): bad datum or missing "
                "effect",
                conflict.id, size_in_words(conflict.size), conflict.measured_mm,
                conflict.nearest_mm, conflict.distance_sd);
            conflicts.push_back(std::move(conflict));
        }
    }
    return conflicts;
}

}  // namespace taylorcal::calibrate
