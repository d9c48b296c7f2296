#pragma once

#include "calibrate/diagnosis/adequacy.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// The hypothesis that one shot, or one number of it, is wrong.
struct Suspect {
    std::size_t shot = 0;
    std::string size;                ///< empty: the whole shot
    std::vector<Eigen::Index> data;  ///< positions in the problem
    double z = 0;         ///< studentised against the rest of the data; of a shot >= 0
    double p = 1;         ///< family-wise over all shots and numbers
    double log_gain = 0;  ///< ln Z with errors 3 to 30 times as large, over all its peers
};

/// Every shot and every number of shots with several, in the order of the data.
std::vector<Suspect> suspect_data(const DiagnosisProblem& problem,
                                  const Whitening& whiten, const Refit& fit);

/// Whether the rest of the data is explained when the suspect's are left out.
bool is_adequate_without(const DiagnosisProblem& problem, const Refit& fit,
                         const Suspect& suspect, const NormalTable& table);

}  // namespace taylorcal::calibrate
