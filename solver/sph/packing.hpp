#pragma once

#include "solver/specimen/shape.hpp"

#include <cstddef>
#include <vector>

namespace taylorcal::sph {

/// Slots of one block: as many as a vector of floats has lanes.
inline constexpr std::size_t block_size = 16;

/// One horizontal sheet of particles. Those of the two faces lie on the face, so that
/// they meet the anvil where the specimen does.
struct Layer {
    double height;     ///< of its particles [m]
    double low, high;  ///< the slice of the specimen that it stands for [m]
    double volume;     ///< of the profile within it [m3]
    double radius;     ///< of the cylinder of that volume [m]
    double edge;       ///< of the lattice cube here [m]
};

/// A vertical line of lattice sites, at (ix, iy) half edges from the axis. Both are even
/// for one of the two interlaced cubic lattices (slot k is in layer 2k) and odd for the
/// other (layer 2k + 1).
struct Column {
    int ix;
    int iy;
    std::size_t first_slot;   ///< of layer 0 or 1
    std::size_t first_block;  ///< that may hold a site of it

    int parity() const { return ix & 1; }
};

/// Particles on a bcc lattice clipped to a profile of revolution that stands on z = 0,
/// narrower where the profile is thin (see Grading).
///
/// Sites are stored column by column in blocks of 16, with empty blocks before, between
/// and after the columns: a neighbour of every site of a block is then a contiguous run
/// of memory at a fixed distance, and needs no index. Sites outside the specimen have no
/// volume; a column's lowest particle begins a block, so that few blocks are half empty.
/// Each layer's volume is that of the profile: a site owns the part of its square
/// tile inside the outline, sites that would own little give it to their neighbours, and
/// the particle sits at the centre of what it owns.
struct Packing {
    double edge = 0;  ///< of the lattice cube in the rear, the widest [m]
    std::vector<Layer> layers;
    std::vector<Column> columns;
    std::size_t sites_per_column = 0;
    std::size_t blocks_per_column = 0;  ///< with the empty ones after it
    std::size_t slots = 0;
    std::vector<double> x, y, z;  ///< reference positions, by slot [m]
    std::vector<double> volume;   ///< zero where there is no particle [m3]
    std::vector<double>
        local_edge;  ///< of the lattice cube, by slot; empty ones the rear's [m]
    std::vector<std::size_t> active;  ///< blocks that hold a particle
    std::size_t particles = 0;

    std::size_t layer_of(std::size_t column, std::size_t k) const {
        return 2 * k + static_cast<std::size_t>(columns[column].parity());
    }
    /// Slots of the particles of each layer.
    std::vector<std::vector<std::size_t>> slots_by_layer() const;
};

/// Packs `shape` with a lattice edge of `edge` in the rear [m], along the axis adjusted
/// so that whole layers fit between the profile's stations.
Packing pack(const specimen::Shape& shape, double edge);

}  // namespace taylorcal::sph
