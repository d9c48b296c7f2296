#pragma once

#include "calibrate/comparison/shot_comparison.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// What leaving one fitted shot out would change, by reweighting the draws by
/// 1/p(y_shot | the others' y, theta): where shots of a lot have the network's error in
/// common, their residuals say part of the shot's own.
struct Influence {
    std::string id;
    double largest_shift_sd = 0;  ///< of a parameter's mean, in its posterior sd
    std::string parameter;        ///< the parameter that shifts most
    double chi2_left_out =
        0;              ///< of the shot, predicted from the others' draws and errors
    std::size_t n = 0;  ///< its sizes
    double effective_draws = 0;  ///< few: the shift is a lower bound only
};

/// In the order of the table.
std::vector<Influence> leave_one_out(const ComparisonInputs& inputs,
                                     const std::vector<ShotComparison>& shots);

}  // namespace taylorcal::calibrate
