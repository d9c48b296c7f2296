#pragma once

#include "calibrate/likelihood/spread_levels.hpp"
#include "calibrate/sampling/draw_pool.hpp"
#include "calibrate/sampling/parameter_space.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// One axis of a map: in which cell each draw falls, and the cells' edges.
struct MapAxis {
    std::string name;
    bool per_decade = false;
    std::vector<double> edges;       ///< plain values, one more than cells
    std::vector<double> widths;      ///< of the cells, in units or decades
    std::vector<Eigen::Index> cell;  ///< of each draw; -1 outside
    double smoothing_cells = 0;      ///< standard deviation of the smoothing kernel

    Eigen::Index cells() const { return static_cast<Eigen::Index>(widths.size()); }
};

/// Axis of coordinate `i` of the parameter space, over the middle 99.9 % of the draws and
/// a margin. The kernel follows Silverman's rule for maps of `dimensions`.
MapAxis parameter_axis(const WeightedDraws& draws, const ParameterSpace& space,
                       std::size_t i, Eigen::Index cells, int dimensions);

/// Axis of equal cells between two places of the unit interval, without draws or kernel.
MapAxis unit_axis(const ParameterSpace& space, std::size_t i, double low, double high,
                  Eigen::Index cells);

/// Silverman's rule: standard deviation of the kernel for maps of `dimensions` made of
/// `effective` draws.
double smoothing(double sd, double effective, int dimensions);

/// Axis of the relative spread, a cell a level.
MapAxis spread_axis(const WeightedDraws& draws, const SpreadLevels& levels);

/// Smooths the rows of `mass` (cells x anything) along the axis by a Gaussian that is
/// reflected at both ends, so that mass is kept and a flat density stays flat.
RowMatrix smooth_rows(const RowMatrix& mass, double smoothing_cells);

}  // namespace taylorcal::calibrate
