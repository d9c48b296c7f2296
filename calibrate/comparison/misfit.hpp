#pragma once

#include "calibrate/comparison/shot_comparison.hpp"

#include <vector>

namespace taylorcal::calibrate {

/// The misfit of all shots of one use, at the best maximum, each by its own C.
struct Misfit {
    std::size_t n = 0;            ///< data
    double chi2 = 0;              ///< sum of squared whitened residuals
    double chi2_with_spread = 0;  ///< C with the spread of the best maximum
    double rms_relative = 0;
    double whitened_rms = 0;
};

Misfit misfit(const std::vector<ShotComparison>& shots, Use use, double best_spread);

}  // namespace taylorcal::calibrate
