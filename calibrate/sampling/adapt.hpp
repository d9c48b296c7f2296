#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"
#include "calibrate/sampling/proposal.hpp"

#include <cstdint>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Draws below this effective size are called "not enough".
inline constexpr double enough_draws = 1000;

/// A proposal that suits the posterior, and the point at which the errors' df/dv is
/// taken.
struct Adaptation {
    Proposal proposal;
    Eigen::VectorXd reference;
    std::uint64_t passes = 0;
    std::uint64_t predictions = 0;
};

/// Finds the proposal by passes over a few thousand draws. The first draws from the
/// prior; it is kept if it would give twice `enough_draws`. Else the likelihood is let in
/// gradually, raised to the largest power that leaves a tenth of the draws effective. The
/// reference point starts at the prior's centre and follows the best draw.
Adaptation adapt(const Settings& settings, const DataSet& set,
                 const ParameterSpace& space, const Predictor& predictor, int threads);

}  // namespace taylorcal::calibrate
