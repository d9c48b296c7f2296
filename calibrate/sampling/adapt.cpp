#include "calibrate/sampling/adapt.hpp"

#include "calibrate/sampling/block_pass.hpp"
#include "calibrate/sampling/draw_weights.hpp"
#include "calibrate/sampling/fit_proposal.hpp"
#include "common/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <spdlog/spdlog.h>

namespace taylorcal::calibrate {
namespace {

constexpr std::uint64_t most_passes = 25;
constexpr std::uint64_t fewest_draws_of_pass = 1000;
constexpr std::uint64_t most_draws_of_pass = 4000;
constexpr double effective_share = 0.1;  // of the draws, to fit a proposal to

DrawTable evaluate_pass(const Pass& pass) {
    std::vector<DrawTable> tables;
    run_pass(
        pass, [](DrawTable table) { return table; },
        [&tables](DrawTable table) { tables.push_back(std::move(table)); }, [] {});
    return join(tables);
}

/// The largest power up to 1 of the likelihood that leaves `wanted` effective draws. At
/// small powers the proposal may not cover the target any more, so the search comes from
/// above; if none leaves so many, the power that leaves most.
double largest_power(const DrawTable& table, const SpreadLevels& levels, double wanted) {
    constexpr double step = 0.25;  // of log2
    constexpr int most_powers = 64;
    double best_power = 1, most = 0;
    for (int i = 0; i <= most_powers; ++i) {
        const double power = std::exp2(-step * i);
        const double effective = DrawWeights(table, levels, power).effective_size();
        if (effective >= wanted) return power;
        if (effective <= most) continue;
        most = effective;
        best_power = power;
    }
    return best_power;
}

/// The point of the unit cube with the largest likelihood times spread prior.
Eigen::VectorXd best_point(const DrawTable& table, const SpreadLevels& levels,
                           const ParameterSpace& space) {
    double best = -std::numeric_limits<double>::infinity();
    Eigen::VectorXd point =
        Eigen::VectorXd::Constant(static_cast<Eigen::Index>(space.size()), 0.5);
    for (Eigen::Index k = 0; k < table.draws(); ++k) {
        if (!std::isfinite(table.log_shared(k))) continue;
        for (std::size_t g = 0; g < levels.values.size(); ++g) {
            double total = levels.log_mass[g];
            Eigen::VectorXd candidate(point.size());
            candidate.head(table.shared.cols()) = table.shared.row(k).transpose();
            for (std::size_t lot = 0; lot < table.own.size(); ++lot) {
                const Eigen::Index from = k * table.inner;
                Eigen::VectorXd inner = table.log_likelihood[lot]
                                            .col(static_cast<Eigen::Index>(g))
                                            .segment(from, table.inner);
                for (Eigen::Index m = 0; m < table.inner; ++m)
                    if (!std::isfinite(table.log_own[lot](from + m)))
                        inner(m) = -std::numeric_limits<double>::infinity();
                Eigen::Index m = 0;
                total += inner.maxCoeff(&m);
                candidate.segment(static_cast<Eigen::Index>(space.lot_offset(lot)),
                                  table.own[lot].cols()) =
                    table.own[lot].row(from + m).transpose();
            }
            if (total > best) {
                best = total;
                point = candidate;
            }
        }
    }
    return point;
}

/// One pass with the proposal that comes next, and what follows from it.
void take_pass(Adaptation& search, const Settings& settings, const DataSet& set,
               const ParameterSpace& space, const Predictor& predictor, int threads) {
    const std::uint64_t draws =
        std::clamp(settings.draws / 5, fewest_draws_of_pass, most_draws_of_pass);
    const double wanted = effective_share * static_cast<double>(draws);
    ++search.passes;
    const LotLikelihood likelihood(settings, set, space, predictor, search.reference);
    const DrawNumbers numbers(settings.seed, search.passes);
    const DrawTable table = evaluate_pass(
        {likelihood, search.next, numbers, draws, settings.draws_per_lot, threads});
    search.predictions +=
        draws * static_cast<std::uint64_t>(table.inner) * likelihood.shots();
    const SpreadLevels& levels = likelihood.levels();
    const double effective = DrawWeights(table, levels).effective_size();
    search.reference = best_point(table, levels, space);
    if (effective > search.most_effective) {
        search.most_effective = effective;
        search.proposal = search.next;
    }
    const double scale = static_cast<double>(settings.draws) / static_cast<double>(draws);
    search.is_done = search.passes == 1 && effective * scale >= 2 * enough_draws;
    if (search.is_done) return;
    const double power = largest_power(table, levels, wanted);
    spdlog::info("pass {}: {:.0f} effective of {} draws, likelihood to the power {:.3g}",
                 search.passes, effective, draws, power);
    // One more pass after the first at full power sharpens the proposal.
    search.is_done = search.is_full && power == 1;
    if (search.is_done) return;
    search.is_full = power == 1;
    const DrawWeights weights(table, levels, power);
    if (!std::isfinite(weights.log_weights().maxCoeff()))
        throw NumericalError(
            "no draw has a likelihood above zero: the predictions are "
            "not finite or the priors exclude every measurement");
    search.next = fit_proposal(table, weights, numbers);
}

}  // namespace

Adaptation::Adaptation(const ParameterSpace& space)
    : proposal(space),
      reference(Eigen::VectorXd::Constant(static_cast<Eigen::Index>(space.size()), 0.5)),
      next(space) {}

void adapt(Adaptation& adaptation, const Settings& settings, const DataSet& set,
           const ParameterSpace& space, const Predictor& predictor, int threads,
           const std::function<void()>& after_pass) {
    while (!adaptation.is_done) {
        take_pass(adaptation, settings, set, space, predictor, threads);
        adaptation.is_done |= adaptation.passes == most_passes;
        after_pass();
    }
}

}  // namespace taylorcal::calibrate
