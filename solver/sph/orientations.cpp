#include "solver/sph/orientations.hpp"

#include "solver/material/isotropic_set.hpp"
#include "solver/material/uniform_rotation.hpp"

#include <map>
#include <numbers>
#include <utility>

namespace taylorcal::sph {

namespace {

/// How many quarter turns bring the site from the first quadrant, and where it was there.
struct QuarterTurns {
    int turns;
    std::pair<int, int> site;
};

QuarterTurns from_first_quadrant(int ix, int iy) {
    int turns = 0;
    while (!(ix > 0 && iy >= 0) && !(ix == 0 && iy == 0)) {
        const int turned_back = -ix;
        ix = iy;
        iy = turned_back;
        ++turns;
    }
    return {turns, {ix, iy}};
}

}  // namespace

std::vector<Eigen::Quaterniond> random_orientations(
    std::uint64_t seed, const Packing& packing, std::size_t grains,
    const std::vector<material::OrientationChange>& changes) {
    constexpr std::uint64_t stream = 0x73706867;
    const RandomStream random(seed, stream);
    const std::vector<Eigen::Quaterniond> set = material::isotropic_set(grains);
    // Numbers of the sites: column by column, whatever the slots.
    const std::size_t stride = (packing.blocks_per_column - 1) * block_size;
    std::map<std::pair<int, int>, std::size_t> first_number;
    std::vector<const Column*> column_of(packing.slots / block_size, nullptr);
    for (const Column& column : packing.columns) {
        const std::size_t number = block_size + first_number.size() * stride;
        first_number[{column.ix, column.iy}] = number;
        for (std::size_t b = 0; b < packing.blocks_per_column; ++b) {
            column_of[column.first_block + b] = &column;
        }
    }
    std::vector<Eigen::Quaterniond> orientations;
    orientations.reserve(packing.active.size() * grains * block_size);
    for (const std::size_t block : packing.active) {
        const Column& column = *column_of[block];
        const QuarterTurns origin = from_first_quadrant(column.ix, column.iy);
        const std::size_t along = block * block_size - column.first_slot;
        const std::size_t first = first_number.at(origin.site) + along;
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(
            origin.turns * std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
        for (std::size_t g = 0; g < grains; ++g) {
            for (std::size_t k = 0; k < block_size; ++k) {
                const Eigen::Quaterniond drawn =
                    turn * material::uniform_rotation(random, first + k) * set[g];
                orientations.push_back(material::changed_orientation(
                    changes, drawn, seed, first + k, g, grains));
            }
        }
    }
    return orientations;
}

}  // namespace taylorcal::sph
