#pragma once

#include "calibrate/sampling/draw_table.hpp"
#include "calibrate/sampling/draw_weights.hpp"
#include "calibrate/sampling/proposal.hpp"

namespace taylorcal::calibrate {

/// The proposal that resembles weighted draws: a mixture of heavy tails over the shared
/// parameters, a weighted regression of each lot's own ones on them, and 10 % prior.
Proposal fit_proposal(const DrawTable& table, const DrawWeights& weights,
                      const DrawNumbers& numbers);

}  // namespace taylorcal::calibrate
