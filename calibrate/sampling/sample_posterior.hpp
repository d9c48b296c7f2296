#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"
#include "calibrate/sampling/checkpoint.hpp"
#include "calibrate/sampling/draw_pool.hpp"

#include <cstdint>
#include <functional>

namespace taylorcal::calibrate {

/// What sampling gives.
struct Posterior {
    WeightedDraws pool;  ///< weighted, several times as many as the kept ones
    WeightedDraws kept;  ///< equally weighted
    double log_evidence = 0;
    double log_evidence_sd = 0;  ///< Monte-Carlo error
    double effective_sample_size = 0;
    std::uint64_t draws = 0;          ///< of the shared parameters, last pass
    std::uint64_t draws_per_lot = 1;  ///< own ones of every lot, for each of them
    std::uint64_t predictions = 0;    ///< shots predicted, all passes
    std::uint64_t adaptations = 0;    ///< passes that looked for the proposal
    bool drawn_from_prior = true;
    Eigen::VectorXd reference;  ///< where df/dv was taken, unit cube
};

/// How a sampling is followed and saved.
struct SamplingRun {
    int threads = 1;
    Checkpoint checkpoint = {};
    std::function<void(std::uint64_t)> advance = {};  ///< told of draws as they are done
};

/// Samples the posterior: `adapt` finds a proposal, and the last pass draws afresh from
/// it, so that the mean weight, the evidence, is unbiased. It streams: memory does not
/// grow with the number of draws. The same bytes for any number of threads. A saved state
/// with the same key is taken up where it was and leads to the same bytes; the last state
/// is saved too. A kill costs at most one pass of the search, or the last second of draws
/// and those that the threads had in hand. `reference`: where df/dv is taken, if not at
/// the best draw.
Posterior sample_posterior(const Settings& settings, const DataSet& set,
                           const ParameterSpace& space, const Predictor& predictor,
                           const SamplingRun& run,
                           const Eigen::VectorXd* reference = nullptr);

}  // namespace taylorcal::calibrate
