#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"
#include "calibrate/sampling/proposal.hpp"

#include <cstdint>
#include <functional>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Draws below this effective size are called "not enough".
inline constexpr double enough_draws = 1000;

/// The search for a proposal that suits the posterior, between two of its passes.
struct Adaptation {
    /// Before the first pass: the prior, and its centre.
    explicit Adaptation(const ParameterSpace& space);

    Proposal proposal;          ///< the best one yet
    Eigen::VectorXd reference;  ///< the point at which the errors' df/dv is taken
    std::uint64_t passes = 0;
    std::uint64_t predictions = 0;
    bool is_done = false;

    Proposal next;  ///< to be tried
    double most_effective = 0;
    bool is_full = false;  ///< the last pass let in all of the likelihood

    template <class Numbers>
    void visit(Numbers& numbers) {
        numbers(proposal, reference, passes, predictions, is_done, next, most_effective,
                is_full);
    }
};

/// Finds the proposal by passes over a few thousand draws. The first draws from the
/// prior; it is kept if it would give twice `enough_draws`. Else the likelihood is let in
/// gradually, raised to the largest power that leaves a tenth of the draws effective. The
/// reference point starts at the prior's centre and follows the best draw. Goes on from
/// `adaptation`, and calls `after_pass` whenever that may be saved.
void adapt(Adaptation& adaptation, const Settings& settings, const DataSet& set,
           const ParameterSpace& space, const Predictor& predictor, int threads,
           const std::function<void()>& after_pass);

}  // namespace taylorcal::calibrate
