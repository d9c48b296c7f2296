#include "calibrate/prior_pass/sample_prior.hpp"

#include "calibrate/prior_pass/data_subsets.hpp"
#include "common/errors.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/core.h>
#include <spdlog/spdlog.h>

namespace taylorcal::calibrate {
namespace {

/// Of the posterior's mass, for all draws that are dropped together: far below the
/// Monte-Carlo error of any number of draws that can be made.
constexpr double dropped_share = 1e-6;

/// Effective draws of the short adapted sampling are about a third.
constexpr std::uint64_t pilot_draws = 20000;

constexpr std::size_t pooled_per_kept = 8;

Settings pilot_settings(Settings settings) {
    settings.draws_from = DrawsFrom::adapted;
    settings.draws = pilot_draws;
    return settings;
}

MapRanges ranges_of(const WeightedDraws& pilot, const ParameterSpace& space) {
    MapRanges ranges;
    for (std::size_t d = 0; d < space.size(); ++d) {
        const MapAxis axis = parameter_axis(pilot, space, d, 1, 1);
        ranges.low.push_back(std::clamp(space.unit(d, axis.edges.front()), 0.0, 1.0));
        ranges.high.push_back(std::clamp(space.unit(d, axis.edges.back()), 0.0, 1.0));
    }
    return ranges;
}

/// Moments of weighted draws, in plain values or their logarithms.
Progression progression_of(const Posterior& found, const ParameterSpace& space) {
    const auto n = static_cast<Eigen::Index>(space.size());
    Progression p{static_cast<double>(found.draws),
                  found.log_evidence,
                  found.log_evidence_sd,
                  found.effective_sample_size,
                  Eigen::VectorXd::Zero(n),
                  Eigen::VectorXd::Zero(n)};
    for (Eigen::Index d = 0; d < n; ++d) {
        const auto i = static_cast<std::size_t>(d);
        Eigen::VectorXd values = found.pool.units.col(d).unaryExpr(
            [&](double unit) { return space.value(i, unit); });
        if (space.parameter(i).log_uniform) values = values.array().log10();
        p.mean(d) = values.dot(found.pool.weights);
        p.sd(d) = std::sqrt(
            (values.array() - p.mean(d)).square().matrix().dot(found.pool.weights));
    }
    return p;
}

}  // namespace

PlainResult sample_prior(const Settings& settings, const DataSet& set,
                         const ParameterSpace& space, const NetworkPredictor& predictor,
                         const SamplingRun& run) {
    const Posterior pilot =
        sample_posterior(pilot_settings(settings), set, space, predictor,
                         {run.threads, run.checkpoint.of_part("pilot")});
    const LotLikelihood likelihood(settings, set, space, predictor, pilot.reference);
    const Pruning pruning(likelihood, pilot.log_evidence, dropped_share);
    const RowNetwork network(predictor, likelihood, pruning.misfit_levels());
    const UnitSequence sequence(settings.draw_sequence, settings.seed, space.size());
    PlainPass pass{network, pruning, sequence, {}, settings.draws};
    pass.row_order = discriminating_order(
        network, pruning,
        UnitSequence(DrawSequence::random, settings.seed + 1, space.size()));
    RunningResult result(pruning, space, likelihood.levels(),
                         ranges_of(pilot.pool, space), settings.draw_sequence,
                         settings.seed, pooled_per_kept * settings.kept_draws);
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t resumed =
        run_plain_pass(pass, result, run.threads, run.checkpoint, run.advance);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    PlainResult plain;
    plain.posterior.pool = result.pool();
    if (plain.posterior.pool.weights.size() == 0)
        throw NumericalError(fmt::format(
            "no draw of {} has a likelihood that matters; raise draws", settings.draws));
    plain.posterior.kept =
        resample(plain.posterior.pool, settings.kept_draws,
                 DrawNumbers(settings.seed, 0)(DrawNumbers::Purpose::start, 0));
    plain.posterior.log_evidence = result.log_evidence();
    plain.posterior.log_evidence_sd = result.log_evidence_sd();
    plain.posterior.effective_sample_size = result.effective_size();
    plain.posterior.draws = settings.draws;
    plain.posterior.predictions = pilot.predictions + result.rows_seen();
    plain.posterior.adaptations = pilot.adaptations;
    plain.posterior.reference = likelihood.reference();
    plain.maps = result.maps();
    plain.convergence = result.convergence();
    plain.dropping = {result.dropped_bound(), static_cast<double>(result.rows_seen()) /
                                                  static_cast<double>(result.draws())};
    spdlog::info(
        "{:.3g} plain draws in {:.1f} s, {:.3g} a second and thread, {:.2f} of {} "
        "rows each; dropped draws hold less than {:.1e} of the posterior",
        static_cast<double>(settings.draws - resumed), seconds,
        static_cast<double>(settings.draws - resumed) / seconds / run.threads,
        plain.dropping.rows_per_draw, network.rows(), plain.dropping.mass_bound);
    return plain;
}

std::vector<SubsetFindings> sample_subsets(const Settings& settings, const DataSet& set,
                                           const ParameterSpace& space,
                                           const NetworkPredictor& predictor,
                                           const SamplingRun& run,
                                           const Eigen::VectorXd& reference) {
    std::vector<SubsetFindings> findings;
    for (const DataSubset& subset : data_subsets(set)) {
        spdlog::info("{} alone", subset.name);
        const Posterior found = sample_posterior(
            pilot_settings(settings), subset.set, space, predictor,
            {run.threads, run.checkpoint.of_part(subset.name)}, &reference);
        findings.push_back({subset.name, progression_of(found, space),
                            make_maps(found.pool, space, spread_levels(settings))});
    }
    return findings;
}

}  // namespace taylorcal::calibrate
