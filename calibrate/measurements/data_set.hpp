#pragma once

#include "calibrate/measurements/shot.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A shot with those of its measured sizes that are fitted.
struct Datum {
    Shot shot;
    std::size_t lot = 0;                ///< position in DataSet::lots
    std::vector<Eigen::Index> columns;  ///< which fitted sizes it has, rising
    Eigen::VectorXd measured_mm;
    Eigen::VectorXd sd_mm;
    /// What relative deviations refer to: the measured size, but the initial length for
    /// the undeformed part, of which nothing may be left, and the initial diameter for a
    /// score of the outline, which may be zero.
    Eigen::VectorXd scale_mm;
};

/// The shots that are fitted or held back, grouped by lot. Lots that are only held back
/// are kept: their own parameters follow the prior.
struct DataSet {
    std::vector<std::string> sizes;  ///< the fitted sizes
    std::vector<std::string> lots;   ///< in order of first appearance
    std::vector<Datum> data;         ///< calibrate and validate rows, in table order

    std::vector<const Datum*> fitted() const;
};

/// Picks the rows in use and their fitted sizes; rows with none of the sizes are left
/// out. InputError when nothing is left to fit.
DataSet make_data_set(const std::vector<Shot>& shots,
                      const std::vector<std::string>& sizes);

}  // namespace taylorcal::calibrate
