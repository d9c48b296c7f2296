#include "calibrate/commands/sample.hpp"

#include "calibrate/posterior/posterior_file.hpp"
#include "calibrate/posterior/summary.hpp"
#include "calibrate/sampling/adapt.hpp"
#include "common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

}  // namespace

void sample(const InputPaths& paths, const std::filesystem::path& out, int threads) {
    const StudyInputs inputs(paths);
    PosteriorResult result;
    {
        // Made with the first draws: the search for the proposal has no known length.
        std::optional<Progress> progress;
        result.posterior =
            sample_posterior(inputs.settings, inputs.set, inputs.space, inputs.predictor,
                             threads, [&](std::uint64_t done) {
                                 if (!progress)
                                     progress.emplace("sampling", inputs.settings.draws);
                                 progress->advance(done);
                             });
    }
    const LotLikelihood likelihood(inputs.settings, inputs.set, inputs.space,
                                   inputs.predictor, result.posterior.reference);
    result.maps = make_maps(result.posterior.pool, inputs.space, likelihood.levels());
    result.maxima =
        find_maxima(likelihood, result.posterior.kept, result.posterior.log_evidence);
    write_posterior(out, result, inputs.space, likelihood.levels(), inputs.settings);
    print_result(result, inputs.space, likelihood.levels(), inputs.settings);
    warn_of_doubts(result.posterior, likelihood.levels());
}

}  // namespace taylorcal::calibrate
