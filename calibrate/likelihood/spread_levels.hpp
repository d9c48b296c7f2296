#pragma once

#include "calibrate/settings/settings.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// The grid of a relative spread over which the likelihood is marginalised, with the
/// prior mass of each level. In the full likelihood it is tau of C = ... + tau^2
/// diag(y^2); in the paper's, the one sigma of all relative deviations.
struct SpreadLevels {
    std::string name;            ///< of its column among the draws; empty if it is fixed
    std::vector<double> values;  ///< relative spread of each level
    std::vector<double> edges;   ///< of the cells that the levels stand for
    std::vector<double> log_mass;

    bool is_free() const { return values.size() > 1; }
};

/// Half-normal prior mass of each cell of the grid; the last cell reaches to infinity.
SpreadLevels unexplained_spread_levels(const UnexplainedSpread& spread);

/// The paper's sigma, 0.1 % to 100 %, uniform in its logarithm (scale-free).
SpreadLevels relative_sigma_levels();

/// The levels that `settings` ask for; one level 0 if there is no unexplained spread.
SpreadLevels spread_levels(const Settings& settings);

}  // namespace taylorcal::calibrate
