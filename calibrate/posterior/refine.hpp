#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A point of the unit cube at one level of the relative spread.
struct RefinedPoint {
    Eigen::VectorXd unit;
    std::size_t level = 0;
};

/// Climbs on the network from a draw to the local maximum of the posterior density, in
/// turn with the best level of the spread.
///
/// Where lots have parameters of their own, it is the maximum over the shared parameters
/// of the density averaged over the lots' (Laplace's approximation of that average), with
/// the lots' own at their best: the peak that the maps show. The joint density would lead
/// along a ridge to where the lots' parameters happen to be known best, far from the
/// bulk. `size`: the spread of the draws around, for the first steps.
RefinedPoint refine(const LotLikelihood& likelihood, const Eigen::VectorXd& start,
                    const Eigen::VectorXd& size);

}  // namespace taylorcal::calibrate
