#include "solver/sph/packing.hpp"

#include "solver/sph/grading.hpp"

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
// Discs are told apart to a part of a sample, since those of a graded lattice all differ.
constexpr int radii_per_edge = 4 * samples_per_edge;
// The thickness that the layer on a face stands for, in layers. One that stood for half a
// layer, as geometry has it, would let a uniform stress pull at the layers above it as
// well: the gradients there are one-sided, and their sum over the particles does not
// vanish as it does inside. The foot's lowest layer would then flow out by a per cent
// more than the metal above it, however fine the lattice. With this share the face alone
// is pulled, within 2 % (see the integration constraint of Chen et al. 2013, doi
// 10.1002/nme.4512).
constexpr double face_layer = 0.84;

/// Layers between the stations, each near half a local lattice edge thick.
std::vector<Layer> slice(const specimen::Shape& shape, double edge) {
    const Grading grading(shape);
    std::vector<Layer> layers;
    const std::size_t stretches = shape.station_height.size() - 1;
    for (std::size_t s = 0; s < stretches; ++s) {
        const double bottom = shape.station_height[s], top = shape.station_height[s + 1];
        if (top <= bottom) continue;
        const double first = s == 0 ? face_layer : 0;
        const double last = s + 1 == stretches ? face_layer : 0;
        const double length = grading.stretched_length(s);
        const double whole =
            std::max(1.0, std::round(length / (edge / 2) - first - last));
        const double thickness = length / (whole + first + last);
        const auto add = [&](double low, double high, double height) {
            const auto radius = [&](double z) {
                return std::lerp(shape.station_radius[s], shape.station_radius[s + 1],
                                 (z - bottom) / (top - bottom));
            };
            const double r0 = radius(low), r1 = radius(high);
            const double area = std::numbers::pi / 3 * (r0 * r0 + r0 * r1 + r1 * r1);
            layers.push_back({height, low, high, area * (high - low),
                              std::sqrt(area / std::numbers::pi),
                              edge * grading.share(s, (low + high) / 2)});
        };
        double low = bottom;
        if (first > 0) {
            const double high = grading.height_at(s, first * thickness);
            add(low, high, bottom);
            low = high;
        }
        for (double i = 1; i <= whole; ++i) {
            const double high = last == 0 && i == whole
                                    ? top
                                    : grading.height_at(s, (first + i) * thickness);
            add(low, high, (low + high) / 2);
            low = high;
        }
        if (last > 0) add(low, top, top);
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

/// The sites of `kept` nearest to a point in the tile of `site`. Equally near ones share
/// what lies there, which keeps the lattice's symmetry.
std::vector<Site> nearest_sites(const Patches& kept, const Site& site, double x,
                                double y) {
    constexpr int reach = 4;  // half edges
    std::vector<Site> owners;
    double least = INFINITY;
    for (int ix = site.first - reach; ix <= site.first + reach; ix += 2) {
        for (int iy = site.second - reach; iy <= site.second + reach; iy += 2) {
            if (!kept.contains({ix, iy})) continue;
            const double distance = std::hypot(ix / 2.0 - x, iy / 2.0 - y);
            if (distance > least + 1e-9) continue;
            if (distance < least - 1e-9) owners.clear();
            least = std::min(least, distance);
            owners.push_back({ix, iy});
        }
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
    for (const auto& tile : covered) {
        const Site& site = tile.first;
        if (kept.contains(site)) continue;
        sample_tile(site, [&](double x, double y) {
            if (x * x + y * y >= r2) return;
            const std::vector<Site> owners = nearest_sites(kept, site, x, y);
            for (const Site& owner : owners) {
                owned[owner].add(x, y, sample_area / static_cast<double>(owners.size()));
            }
        });
    }
    return owned;
}

}  // namespace

std::vector<std::vector<std::size_t>> Packing::slots_by_layer() const {
    std::vector<std::vector<std::size_t>> by_layer(layers.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
        for (std::size_t k = 0; k < sites_per_column; ++k) {
            const std::size_t slot = columns[c].first_slot + k;
            if (volume[slot] > 0) by_layer[layer_of(c, k)].push_back(slot);
        }
    }
    return by_layer;
}

Packing pack(const specimen::Shape& shape, double edge) {
    Packing packing;
    packing.edge = edge;
    packing.layers = slice(shape, edge);

    std::vector<Patches> tiles;
    std::map<std::pair<long, std::size_t>, std::size_t> alike;  // layers, by their disc
    std::map<Site, std::size_t> column_of;
    for (std::size_t l = 0; l < packing.layers.size(); ++l) {
        const Layer& layer = packing.layers[l];
        const long width = std::lround(layer.radius / layer.edge * radii_per_edge);
        const auto [same, is_new] = alike.try_emplace({width, l % 2}, l);
        tiles.push_back(is_new ? tile_disc(static_cast<double>(width) / radii_per_edge,
                                           static_cast<int>(l % 2))
                               : tiles[same->second]);
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
    packing.local_edge.assign(packing.slots, edge);
    for (std::size_t l = 0; l < packing.layers.size(); ++l) {
        double total = 0;
        for (const auto& [site, patch] : tiles[l]) total += patch.area;
        for (const auto& [site, patch] : tiles[l]) {
            const Column& column = packing.columns[column_of[site]];
            const std::size_t slot = column.first_slot + l / 2;
            const double local_edge = packing.layers[l].edge;
            packing.local_edge[slot] = local_edge;
            packing.x[slot] = local_edge * patch.x / patch.area;
            packing.y[slot] = local_edge * patch.y / patch.area;
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
