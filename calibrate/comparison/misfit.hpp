#pragma once

#include "calibrate/comparison/shot_comparison.hpp"

#include <vector>

namespace taylorcal::calibrate {

/// The misfit of all shots of one use, at the best maximum.
struct Misfit {
    std::size_t n = 0;            ///< data
    double chi2 = 0;              ///< sum of squared whitened residuals
    double chi2_with_spread = 0;  ///< C with the spread of the best maximum
    double p_effective = 0;       ///< parameters that the data could bend (fitted shots)
    double rms_relative = 0;
    double whitened_rms = 0;
};

/// p_effective = mean over the draws of chi2 less chi2 at the best maximum, both with the
/// spread of that maximum (Spiegelhalter et al. 2002, doi 10.1111/1467-9868.00353).
Misfit misfit(const std::vector<ShotComparison>& shots, Use use, double best_spread);

}  // namespace taylorcal::calibrate
