#include "calibrate/commands/sample.hpp"

#include "calibrate/posterior/posterior_file.hpp"
#include "calibrate/posterior/summary.hpp"
#include "calibrate/prior_pass/sample_prior.hpp"
#include "calibrate/sampling/adapt.hpp"
#include "common/atomic_file.hpp"
#include "common/program_code.hpp"
#include "common/progress.hpp"
#include "common/sha256.hpp"
#include "common/simd.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>

#include <fmt/core.h>
#include <spdlog/spdlog.h>

namespace taylorcal::calibrate {
namespace {

void print_result(const PosteriorResult& result, const ParameterSpace& space,
                  const SpreadLevels& levels, const Settings& settings) {
    const Posterior& posterior = result.posterior;
    const Maximum& best = result.maxima.front();
    const RowMatrix maximum =
        plain_columns(best.unit.transpose(), {best.level}, space, levels);
    const RowMatrix draws =
        plain_columns(posterior.kept.units, posterior.kept.levels, space, levels);
    fmt::print("{}", parameter_table(
                         summarise(column_names(space, levels), draws, maximum.row(0))));
    fmt::print("maxima: {}", result.maxima.size());
    for (const Maximum& m : result.maxima) fmt::print("  {:.0f} %", 100 * m.share);
    fmt::print("\n");
    if (settings.likelihood == LikelihoodForm::full)
        fmt::print("ln evidence: {:.2f} +- {:.2f}\n", posterior.log_evidence,
                   posterior.log_evidence_sd);
    fmt::print("effective sample size: {:.0f} of {} draws{}, {:.3g} shots predicted\n",
               posterior.effective_sample_size, posterior.draws,
               posterior.draws_per_lot > 1
                   ? fmt::format(" with {} a lot for each", posterior.draws_per_lot)
                   : "",
               static_cast<double>(posterior.predictions));
}

void warn_of_doubts(const Posterior& posterior, const SpreadLevels& levels) {
    if (posterior.effective_sample_size < enough_draws)
        spdlog::warn(
            "not enough draws: {:.0f} effective, at least {:.0f} are needed for "
            "reliable intervals. Raise draws or draws_per_lot.",
            posterior.effective_sample_size, enough_draws);
    const auto& found = posterior.kept.levels;
    const auto at_end = std::count(found.begin(), found.end(), levels.values.size() - 1);
    if (levels.is_free() && 10 * at_end > static_cast<std::ptrdiff_t>(found.size()))
        spdlog::warn(
            "{} of {} draws have the largest {} of its grid, {:g}. Extend the grid "
            "in unexplained_spread, or look for what the model misses.",
            at_end, found.size(), levels.name, levels.values.back());
}

/// Tells every input, so that what an interrupted run saved is taken up by the same only.
std::string digest_of(const InputPaths& paths) {
    std::string all = program_code() + simd::name(simd::variant());
    for (const auto& path : {paths.settings, paths.measurements, paths.emulator})
        all += ' ' + sha256_of_file(path);
    return sha256(all);
}

/// Told of draws as they are done; the bar is made with the first ones, since the search
/// for a proposal before has no known length.
std::function<void(std::uint64_t)> bar(std::optional<Progress>& progress,
                                       std::uint64_t total) {
    return [&progress, total](std::uint64_t done) {
        if (!progress) progress.emplace("sampling", total);
        progress->advance(done);
    };
}

PosteriorResult sample_plain(const StudyInputs& inputs, const SamplingRun& run) {
    PlainResult found =
        sample_prior(inputs.settings, inputs.set, inputs.space, inputs.predictor, run);
    PosteriorResult result;
    result.plain = {
        std::move(found.convergence), found.dropping,
        sample_subsets(inputs.settings, inputs.set, inputs.space, inputs.predictor,
                       {run.threads, run.checkpoint}, found.posterior.reference)};
    result.posterior = std::move(found.posterior);
    result.maps = std::move(found.maps);
    return result;
}

PosteriorResult sample_adapted(const StudyInputs& inputs, const SamplingRun& run) {
    PosteriorResult result;
    result.posterior = sample_posterior(inputs.settings, inputs.set, inputs.space,
                                        inputs.predictor, run);
    result.maps =
        make_maps(result.posterior.pool, inputs.space, spread_levels(inputs.settings));
    return result;
}

void print_subsets(const PlainFindings& findings, const ParameterSpace& space) {
    fmt::print(
        "dropped draws hold less than {:.1e} of the posterior; {:.2f} rows a draw\n",
        findings.dropping.mass_bound, findings.dropping.rows_per_draw);
    for (const SubsetFindings& subset : findings.subsets) {
        fmt::print("{}:", subset.name);
        for (std::size_t d = 0; d < space.size(); ++d)
            fmt::print(" {}{} {:.4g} +- {:.2g}",
                       space.parameter(d).log_uniform ? "lg " : "", space.names()[d],
                       subset.summary.mean(static_cast<Eigen::Index>(d)),
                       subset.summary.sd(static_cast<Eigen::Index>(d)));
        fmt::print("\n");
    }
}

}  // namespace

void sample(const InputPaths& paths, const std::filesystem::path& out, int threads) {
    require_writable(out, {paths.settings, paths.measurements, paths.emulator});
    const StudyInputs inputs(paths);
    const bool plain = inputs.settings.draws_from == DrawsFrom::prior;
    const Checkpoint checkpoint{out.string() + ".checkpoint", digest_of(paths)};
    PosteriorResult result;
    {
        std::optional<Progress> progress;
        const SamplingRun run{threads, checkpoint, bar(progress, inputs.settings.draws)};
        result = plain ? sample_plain(inputs, run) : sample_adapted(inputs, run);
    }
    const LotLikelihood likelihood(inputs.settings, inputs.set, inputs.space,
                                   inputs.predictor, result.posterior.reference);
    result.maxima =
        find_maxima(likelihood, result.posterior.kept, result.posterior.log_evidence);
    write_posterior(out, result, inputs.space, likelihood.levels(), inputs.settings);
    remove(checkpoint);
    print_result(result, inputs.space, likelihood.levels(), inputs.settings);
    if (result.plain) print_subsets(*result.plain, inputs.space);
    warn_of_doubts(result.posterior, likelihood.levels());
}

}  // namespace taylorcal::calibrate
