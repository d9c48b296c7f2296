#include "calibrate/posterior/maps.hpp"

namespace taylorcal::calibrate {
namespace {

constexpr Eigen::Index cells_1d = 80;
constexpr Eigen::Index cells_2d = 48;

Map1d single_map(const WeightedDraws& draws, const MapAxis& axis) {
    RowMatrix mass = RowMatrix::Zero(axis.cells(), 1);
    for (std::size_t k = 0; k < axis.cell.size(); ++k)
        if (axis.cell[k] >= 0)
            mass(axis.cell[k], 0) += draws.weights(static_cast<Eigen::Index>(k));
    return single_density(axis, std::move(mass));
}

Map2d pair_map(const WeightedDraws& draws, const MapAxis& x, const MapAxis& y) {
    RowMatrix mass = RowMatrix::Zero(x.cells(), y.cells());
    for (std::size_t k = 0; k < x.cell.size(); ++k)
        if (x.cell[k] >= 0 && y.cell[k] >= 0)
            mass(x.cell[k], y.cell[k]) += draws.weights(static_cast<Eigen::Index>(k));
    return pair_density(x, y, std::move(mass));
}

}  // namespace

Map1d single_density(const MapAxis& axis, RowMatrix mass) {
    mass = smooth_rows(mass, axis.smoothing_cells) / mass.sum();
    Map1d map{axis.name, axis.per_decade ? "decade" : "unit", axis.edges, {}};
    for (Eigen::Index c = 0; c < axis.cells(); ++c)
        map.density.push_back(mass(c, 0) / axis.widths[static_cast<std::size_t>(c)]);
    return map;
}

Map2d pair_density(const MapAxis& x, const MapAxis& y, RowMatrix mass) {
    mass /= mass.sum();
    mass = smooth_rows(mass, x.smoothing_cells);
    mass = smooth_rows(mass.transpose(), y.smoothing_cells).transpose().eval();
    for (Eigen::Index i = 0; i < x.cells(); ++i)
        for (Eigen::Index j = 0; j < y.cells(); ++j)
            mass(i, j) /= x.widths[static_cast<std::size_t>(i)] *
                          y.widths[static_cast<std::size_t>(j)];
    return {x.name, y.name, x.edges, y.edges, mass};
}

Maps make_maps(const WeightedDraws& draws, const ParameterSpace& space,
               const SpreadLevels& levels) {
    Maps maps;
    for (std::size_t i = 0; i < space.size(); ++i)
        maps.single.push_back(
            single_map(draws, parameter_axis(draws, space, i, cells_1d, 1)));
    std::vector<MapAxis> shared, own;
    for (std::size_t i = 0; i < space.size(); ++i)
        (i < space.shared_count() ? shared : own)
            .push_back(parameter_axis(draws, space, i, cells_2d, 2));
    if (levels.is_free()) {
        shared.push_back(spread_axis(draws, levels));
        maps.single.push_back(single_map(draws, shared.back()));
    }
    for (std::size_t a = 0; a < shared.size(); ++a) {
        for (std::size_t b = a + 1; b < shared.size(); ++b)
            maps.pairs.push_back(pair_map(draws, shared[a], shared[b]));
        for (const MapAxis& lot : own)
            maps.pairs.push_back(pair_map(draws, shared[a], lot));
    }
    return maps;
}

}  // namespace taylorcal::calibrate
