#pragma once

#include "common/hdf5_file.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// The modes of the smoothed density of points, and to which each point climbs.
struct Basins {
    RowMatrix modes;                  ///< a row a mode
    std::vector<std::size_t> member;  ///< mode of each point
};

/// Mean shift (Comaniciu and Meer 2002, doi 10.1109/34.1000236) with a Gaussian kernel by
/// Silverman's rule. Modes between which the density dips by less than 30 % of the lower
/// one are taken as noise of one mode.
Basins find_basins(const RowMatrix& points);

}  // namespace taylorcal::calibrate
