#pragma once

#include "calibrate/likelihood/spread_levels.hpp"
#include "calibrate/posterior/map_axis.hpp"
#include "calibrate/sampling/draw_pool.hpp"
#include "calibrate/sampling/parameter_space.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// Marginal density of one parameter. Edges are plain values; the density is per unit of
/// the parameter, or per decade where its prior is log-uniform.
struct Map1d {
    std::string name;
    std::string per;  ///< "unit" or "decade"
    std::vector<double> edges;
    std::vector<double> density;
};

/// Joint density of two parameters; density(i, j) belongs to cell i of x and j of y.
struct Map2d {
    std::string x_name, y_name;
    std::vector<double> x_edges, y_edges;
    RowMatrix density;
};

struct Maps {
    std::vector<Map1d> single;
    std::vector<Map2d> pairs;
};

/// Densities of a histogram: `mass` [cells x 1] or [cells of x, cells of y], smoothed by
/// the axes' kernels.
Map1d single_density(const MapAxis& axis, RowMatrix mass);
Map2d pair_density(const MapAxis& x, const MapAxis& y, RowMatrix mass);

/// Smoothed histograms of weighted draws over the range that they fill: every parameter,
/// every pair of shared ones (the spread counts as shared) and each lot's own parameters
/// with each shared one.
Maps make_maps(const WeightedDraws& draws, const ParameterSpace& space,
               const SpreadLevels& levels);

}  // namespace taylorcal::calibrate
