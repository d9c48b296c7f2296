#pragma once

#include "calibrate/measurements/data_set.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// A part of the table, fitted alone.
struct DataSubset {
    std::string name;  ///< e.g. "shape_truncated_cone", "without_truncated_cone"
    DataSet set;
};

/// Each shape alone and each left out; the final length alone, the impact diameter alone,
/// and the other sizes alone (the source paper's Figures 13, A3 and A4). Parts that are
/// empty, or all of the table, are left out.
std::vector<DataSubset> data_subsets(const DataSet& set);

}  // namespace taylorcal::calibrate
