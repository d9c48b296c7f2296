#include "calibrate/posterior/map_axis.hpp"

#include "calibrate/posterior/weighted_quantile.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::calibrate {

MapAxis parameter_axis(const WeightedDraws& draws, const ParameterSpace& space,
                       std::size_t i, Eigen::Index cells, int dimensions) {
    const Eigen::VectorXd u = draws.units.col(static_cast<Eigen::Index>(i));
    const WeightedQuantile quantile(u, draws.weights);
    double low = quantile(0.0005), high = quantile(0.9995);
    const double margin = std::max(0.1 * (high - low), 1e-6);
    low = std::max(low - margin, 0.0);
    high = std::min(high + margin, 1.0);

    MapAxis axis = unit_axis(space, i, low, high, cells);
    const double scale = static_cast<double>(cells) / (high - low);
    for (const double value : u) {
        const auto c = static_cast<Eigen::Index>(std::floor((value - low) * scale));
        axis.cell.push_back(value < low || value > high ? -1 : std::min(c, cells - 1));
    }
    const double mean = u.dot(draws.weights);
    const double sd = std::sqrt((u.array() - mean).square().matrix().dot(draws.weights));
    const double size = 1 / draws.weights.squaredNorm();
    axis.smoothing_cells = smoothing(sd, size, dimensions) * scale;
    return axis;
}

MapAxis unit_axis(const ParameterSpace& space, std::size_t i, double low, double high,
                  Eigen::Index cells) {
    MapAxis axis;
    axis.name = space.names()[i];
    axis.per_decade = space.parameter(i).log_uniform;
    for (Eigen::Index c = 0; c <= cells; ++c)
        axis.edges.push_back(space.value(
            i, low + (high - low) * static_cast<double>(c) / static_cast<double>(cells)));
    for (std::size_t c = 1; c < axis.edges.size(); ++c)
        axis.widths.push_back(axis.per_decade
                                  ? std::log10(axis.edges[c] / axis.edges[c - 1])
                                  : axis.edges[c] - axis.edges[c - 1]);
    return axis;
}

double smoothing(double sd, double effective, int dimensions) {
    return 0.9 * sd * std::pow(effective, -1.0 / (4 + dimensions));
}

MapAxis spread_axis(const WeightedDraws& draws, const SpreadLevels& levels) {
    MapAxis axis;
    axis.name = levels.name;
    axis.edges = levels.edges;
    for (std::size_t c = 1; c < axis.edges.size(); ++c)
        axis.widths.push_back(axis.edges[c] - axis.edges[c - 1]);
    for (const std::size_t level : draws.levels)
        axis.cell.push_back(static_cast<Eigen::Index>(level));
    return axis;
}

RowMatrix smooth_rows(const RowMatrix& mass, double smoothing_cells) {
    if (smoothing_cells < 0.1) return mass;
    const Eigen::Index n = mass.rows();
    const auto kernel = [smoothing_cells](Eigen::Index distance) {
        const double z = static_cast<double>(distance) / smoothing_cells;
        return std::exp(-0.5 * z * z);
    };
    RowMatrix spread(n, n);  // spread(to, from)
    for (Eigen::Index from = 0; from < n; ++from) {
        for (Eigen::Index to = 0; to < n; ++to)
            spread(to, from) =
                kernel(to - from) + kernel(to + from + 1) + kernel(2 * n - 1 - to - from);
        spread.col(from) /= spread.col(from).sum();
    }
    return spread * mass;
}

}  // namespace taylorcal::calibrate
