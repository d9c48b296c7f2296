#include "solver/sph/packing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace taylorcal::sph {

namespace {

using Site = std::pair<int, int>;  // (ix, iy)

/// The part of a layer that a site owns, lengths in edges.
struct Patch {
    double area = 0;
    double x = 0, y = 0;  // first moments of the area

    void add(double px, double py, double part) {
        area += part;
        x += part * px;
        y += part * py;
    }
};
using Patches = std::map<Site, Patch>;

constexpr double least_coverage = 0.35;  // of a tile, for its site to become a particle
constexpr int samples_per_edge = 24;

/// Layers between the stations, each near half a lattice edge thick.
std::vector<Layer> slice(const specimen::Shape& shape, double edge) {
    std::vector<Layer> layers;
    const std::size_t stretches = shape.station_height.size() - 1;
    for (std::size_t s = 0; s < stretches; ++s) {
        const double bottom = shape.station_height[s];
        const double rise = shape.station_height[s + 1] - bottom;
        if (rise <= 0) continue;
        // A face takes half a layer from its end of the stretch.
        const double first = s == 0 ? 0.5 : 0;
        const double last = s + 1 == stretches ? 0.5 : 0;
        const double whole = std::max(1.0, std::round(rise / (edge / 2) - first - last));
        const double thickness = rise / (whole + first + last);
        const auto add = [&](double low, double high, double height) {
            const auto radius = [&](double z) {
                return std::lerp(shape.station_radius[s], shape.station_radius[s + 1],
                                 (z - bottom) / rise);
            };
            const double r0 = radius(low), r1 = radius(high);
            const double area = std::numbers::pi / 3 * (r0 * r0 + r0 * r1 + r1 * r1);
            layers.push_back({height, low, high, area * (high - low),
                              std::sqrt(area / std::numbers::pi)});
        };
        double low = bottom + first * thickness;
        if (first > 0) add(bottom, low, bottom);
        for (double i = 0; i < whole; ++i, low += thickness) {
            add(low, low + thickness, low + thickness / 2);
        }
        if (last > 0) add(low, bottom + rise, bottom + rise);
    }
    return layers;
}

/// Sample points of one tile, evenly spread; positions in edges.
template <class Visit>
void sample_tile(const Site& site, const Visit& visit) {
    for (int i = 0; i < samples_per_edge; ++i) {
        for (int j = 0; j < samples_per_edge; ++j) {
            visit(site.first / 2.0 - 0.5 + (i + 0.5) / samples_per_edge,
                  site.second / 2.0 - 0.5 + (j + 0.5) / samples_per_edge);
        }
    }
}

/// The sites of `kept` nearest to a point. Equally near ones share what lies there, which
/// keeps the lattice's symmetry.
std::vector<Site> nearest_sites(const Patches& kept, double x, double y) {
    std::vector<Site> owners;
    double least = INFINITY;
    for (const auto& [site, patch] : kept) {
        const double distance = std::hypot(site.first / 2.0 - x, site.second / 2.0 - y);
        if (distance > least + 1e-9) continue;
        if (distance < least - 1e-9) owners.clear();
        least = std::min(least, distance);
        owners.push_back(site);
    }
    return owners;
}

/// The part of a disc that each site of one parity owns.
Patches tile_disc(double radius_in_edges, int parity) {
    const double r2 = radius_in_edges * radius_in_edges;
    constexpr double sample_area = 1.0 / (samples_per_edge * samples_per_edge);
    Patches covered;
    double fullest = 0;
    const int reach = 2 * static_cast<int>(std::ceil(radius_in_edges)) + parity;
    for (int ix = -reach; ix <= reach; ix += 2) {
        for (int iy = -reach; iy <= reach; iy += 2) {
            Patch patch;
            sample_tile({ix, iy}, [&](double x, double y) {
                if (x * x + y * y < r2) patch.add(x, y, sample_area);
            });
            if (patch.area > 0) covered[{ix, iy}] = patch;
            fullest = std::max(fullest, patch.area);
        }
    }
    const double limit = std::min(least_coverage, 0.99 * fullest);
    Patches kept;
    for (const auto& [site, patch] : covered) {
        if (patch.area >= limit) kept[site] = patch;
    }
    Patches owned = kept;
    for (const auto& [site, patch] : covered) {
        if (kept.contains(site)) continue;
        sample_tile(site, [&](double x, double y) {
            if (x * x + y * y >= r2) return;
            const std::vector<Site> owners = nearest_sites(kept, x, y);
            for (const Site& owner : owners) {
                owned[owner].add(x, y, sample_area / static_cast<double>(owners.size()));
            }
        });
    }
    return owned;
}

}  // namespace

Packing pack(const specimen::Shape& shape, double edge) {
    Packing packing;
    packing.edge = edge;
    packing.layers = slice(shape, edge);

    std::vector<Patches> tiles;
    std::map<Site, std::size_t> column_of;
    for (std::size_t l = 0; l < packing.layers.size(); ++l) {
        const bool same =
            l >= 2 && packing.layers[l].radius == packing.layers[l - 2].radius;
        tiles.push_back(
            same ? tiles[l - 2]
                 : tile_disc(packing.layers[l].radius / edge, static_cast<int>(l % 2)));
        for (const auto& [site, patch] : tiles.back()) column_of[site] = 0;
    }

    const auto occupied = [&](const Site& site, std::size_t k) {
        return tiles[2 * k + static_cast<std::size_t>(site.first & 1)].contains(site);
    };
    // Blocks for all sites from anywhere within the first one, and an empty one.
    packing.sites_per_column = (packing.layers.size() + 1) / 2;
    packing.blocks_per_column =
        (packing.sites_per_column + block_size - 1) / block_size + 2;
    for (auto& [site, index] : column_of) {
        index = packing.columns.size();
        std::size_t lowest = 0;
        while (!occupied(site, lowest)) ++lowest;
        const std::size_t block = 1 + index * packing.blocks_per_column;
        const std::size_t shift = (block_size - lowest % block_size) % block_size;
        packing.columns.push_back(
            {site.first, site.second, block * block_size + shift, block});
    }
    packing.slots = (1 + packing.columns.size() * packing.blocks_per_column) * block_size;
    for (auto* field : {&packing.x, &packing.y, &packing.z, &packing.volume}) {
        field->assign(packing.slots, 0.0);
    }
    for (std::size_t l = 0; l < packing.layers.size(); ++l) {
        double total = 0;
        for (const auto& [site, patch] : tiles[l]) total += patch.area;
        for (const auto& [site, patch] : tiles[l]) {
            const Column& column = packing.columns[column_of[site]];
            const std::size_t slot = column.first_slot + l / 2;
            packing.x[slot] = edge * patch.x / patch.area;
            packing.y[slot] = edge * patch.y / patch.area;
            packing.z[slot] = packing.layers[l].height;
            packing.volume[slot] = packing.layers[l].volume * patch.area / total;
            ++packing.particles;
        }
    }
    for (std::size_t b = 0; b < packing.slots / block_size; ++b) {
        const auto first = packing.volume.begin() + static_cast<long>(b * block_size);
        if (std::any_of(first, first + block_size, [](double v) { return v > 0; })) {
            packing.active.push_back(b);
        }
    }
    return packing;
}

}  // namespace taylorcal::sph
