#include "calibrate/sampling/sample_posterior.hpp"

#include "calibrate/sampling/block_pass.hpp"
#include "calibrate/sampling/draw_weights.hpp"
#include "calibrate/sampling/sampling_state.hpp"
#include "common/errors.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <spdlog/spdlog.h>

namespace taylorcal::calibrate {
namespace {

using Purpose = DrawNumbers::Purpose;
constexpr std::uint64_t last_pass = 0;  // adaptation passes count from 1
constexpr std::size_t pool_per_kept = 8;

Eigen::Index pick(const Eigen::VectorXd& shares, double uniform) {
    Eigen::Index i = 0;
    while (i + 1 < shares.size() && uniform >= shares(i)) uniform -= shares(i++);
    return i;
}

/// One of the nested draws of draw k, picked by its share of the weight.
ChosenDraw choose(const DrawTable& table, const DrawWeights& weights,
                  const DrawNumbers& numbers, const ParameterSpace& space,
                  Eigen::Index k) {
    ChosenDraw draw;
    draw.number = table.first + static_cast<std::uint64_t>(k);
    draw.log_weight = weights.log_weights()(k);
    draw.log_priority =
        draw.log_weight - std::log(numbers(Purpose::priority, draw.number));
    const Eigen::Index level =
        pick(weights.level_shares(k), numbers(Purpose::choice, draw.number));
    draw.level = static_cast<std::size_t>(level);
    draw.unit.resize(static_cast<Eigen::Index>(space.size()));
    draw.unit.head(table.shared.cols()) = table.shared.row(k).transpose();
    for (std::size_t lot = 0; lot < table.own.size() && space.per_lot_count() > 0;
         ++lot) {
        const Eigen::Index m = pick(weights.own_shares(k, lot, level),
                                    numbers(Purpose::choice, draw.number, lot + 1));
        draw.unit.segment(static_cast<Eigen::Index>(space.lot_offset(lot)),
                          table.own[lot].cols()) =
            table.own[lot].row(k * table.inner + m).transpose();
    }
    return draw;
}

struct BlockResult {
    LogSum weights;
    std::vector<ChosenDraw> draws;
    std::uint64_t count = 0;
};

BlockResult weigh(const DrawTable& table, const Pass& pass) {
    const DrawWeights weights(table, pass.likelihood.levels());
    BlockResult result;
    result.count = static_cast<std::uint64_t>(table.draws());
    for (Eigen::Index k = 0; k < table.draws(); ++k) {
        const double log_weight = weights.log_weights()(k);
        if (!std::isfinite(log_weight)) continue;
        result.weights.add(log_weight);
        result.draws.push_back(
            choose(table, weights, pass.numbers, pass.likelihood.space(), k));
    }
    return result;
}

}  // namespace

Posterior sample_posterior(const Settings& settings, const DataSet& set,
                           const ParameterSpace& space, const Predictor& predictor,
                           const SamplingRun& run, const Eigen::VectorXd* reference) {
    const auto start = std::chrono::steady_clock::now();
    SamplingState state(space, pool_per_kept * settings.kept_draws);
    state.load(run.checkpoint, settings.draws);
    if (state.draws > 0 && run.advance) run.advance(state.draws);
    const Adaptation& adapted = state.adaptation;
    const std::uint64_t inner = space.per_lot_count() > 0 ? settings.draws_per_lot : 1;
    const auto predictions = [&] {
        return adapted.predictions + state.draws * inner * set.fitted().size();
    };
    const std::uint64_t resumed = predictions();
    adapt(state.adaptation, settings, set, space, predictor, run.threads,
          [&] { state.save(run.checkpoint, true); });
    const LotLikelihood likelihood(settings, set, space, predictor,
                                   reference ? *reference : adapted.reference);
    const Pass pass{
        likelihood,     adapted.proposal,       DrawNumbers(settings.seed, last_pass),
        settings.draws, settings.draws_per_lot, run.threads,
        state.draws};
    run_pass(
        pass, [&pass](const DrawTable& table) { return weigh(table, pass); },
        [&](BlockResult block) {
            state.weights.merge(block.weights);
            state.pool.add(std::move(block.draws));
            state.draws += block.count;
            if (run.advance) run.advance(block.count);
        },
        [&] { state.save(run.checkpoint, state.draws == settings.draws); });
    Posterior posterior;
    posterior.pool = state.pool.weighted();
    if (posterior.pool.weights.size() == 0)
        throw NumericalError(
            "no draw of the last pass has a likelihood above zero; raise "
            "draws, or check the priors against the measurements");
    posterior.kept =
        resample(posterior.pool, settings.kept_draws, pass.numbers(Purpose::start, 0));
    const auto draws = static_cast<double>(settings.draws);
    posterior.effective_sample_size = state.weights.effective_size();
    posterior.log_evidence = state.weights.value() - std::log(draws);
    posterior.log_evidence_sd =
        std::sqrt(std::max(0.0, 1 / posterior.effective_sample_size - 1 / draws));
    posterior.draws = settings.draws;
    posterior.draws_per_lot = inner;
    posterior.predictions = predictions();
    posterior.adaptations = adapted.passes;
    posterior.drawn_from_prior = adapted.proposal.is_prior();
    posterior.reference = likelihood.reference();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto made = static_cast<double>(posterior.predictions - resumed);
    spdlog::info("{:.3g} shot predictions in {:.1f} s: {:.3g} a second", made, seconds,
                 made / seconds);
    return posterior;
}

}  // namespace taylorcal::calibrate
