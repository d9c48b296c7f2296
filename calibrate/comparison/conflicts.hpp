#pragma once

#include "calibrate/comparison/shot_comparison.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// A datum that no parameters within their priors reach.
struct Conflict {
    std::string id;
    std::string size;
    double measured_mm = 0;
    double nearest_mm = 0;   ///< nearest prediction of any prior draw
    double distance_sd = 0;  ///< its distance in standard errors
    std::string words;
};

/// Data farther than three standard errors (no spread) from all of a few thousand draws
/// of the prior.
std::vector<Conflict> find_conflicts(const ComparisonInputs& inputs,
                                     const std::vector<ShotComparison>& shots);

}  // namespace taylorcal::calibrate
