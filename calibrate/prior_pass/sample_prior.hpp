#pragma once

#include "calibrate/posterior/maps.hpp"
#include "calibrate/prior_pass/run_plain_pass.hpp"
#include "calibrate/sampling/sample_posterior.hpp"

#include <vector>

namespace taylorcal::calibrate {

/// What a pass of plain draws gives beyond a posterior.
struct PlainResult {
    Posterior posterior;
    Maps maps;
    std::vector<Progression> convergence;
    Dropping dropping;
};

/// Samples the posterior by plain draws from the prior, most of which are dropped after a
/// few rows (see Pruning). A short adapted sampling tells the threshold, the maps' ranges
/// and the point at which df/dv is taken.
PlainResult sample_prior(const Settings& settings, const DataSet& set,
                         const ParameterSpace& space, const NetworkPredictor& predictor,
                         const SamplingRun& run);

/// The parts of the table alone, with the errors of the whole. A posterior that fills one
/// part in a million of the prior leaves few of any plain draws that a part could be
/// given, so that these come from adapted proposals: a part takes a second and has
/// thousands of effective draws.
std::vector<SubsetFindings> sample_subsets(const Settings& settings, const DataSet& set,
                                           const ParameterSpace& space,
                                           const NetworkPredictor& predictor,
                                           const SamplingRun& run,
                                           const Eigen::VectorXd& reference);

}  // namespace taylorcal::calibrate
