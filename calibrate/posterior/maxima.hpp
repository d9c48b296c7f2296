#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"
#include "calibrate/sampling/draw_pool.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A local maximum of the posterior.
struct Maximum {
    Eigen::VectorXd unit;   ///< point of the unit cube
    std::size_t level = 0;  ///< of the relative spread
    double log_density =
        0;             ///< posterior density over the unit cube, spread averaged out
    double share = 0;  ///< of the posterior that climbs to it
};

/// Local maxima of the smoothed density of equally weighted draws over the shared
/// parameters (over all, if none is shared), each refined on the network; the highest
/// density first. In more than four dimensions only one is looked for.
std::vector<Maximum> find_maxima(const LotLikelihood& likelihood,
                                 const WeightedDraws& draws, double log_evidence);

}  // namespace taylorcal::calibrate
