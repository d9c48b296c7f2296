#include "solver/sph/outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace taylorcal::sph {

namespace {

constexpr int angles = 48;            // of tracers around the specimen
constexpr double tolerance = 1e-9;    // between heights that are meant to be one [m]
constexpr int samples_per_edge = 24;  // of the head's section
constexpr double alike = 1e-9;        // squared distances that are meant to be one

Eigen::Vector3d carried(const Particles& particles, std::size_t slot,
                        const Eigen::Vector3d& offset) {
    Eigen::Vector3d point;
    for (std::size_t r = 0; r < 3; ++r) {
        point(static_cast<Eigen::Index>(r)) =
            particles.position[r][slot] +
            particles.deformation[3 * r][slot] * offset.x() +
            particles.deformation[3 * r + 1][slot] * offset.y() +
            particles.deformation[3 * r + 2][slot] * offset.z();
    }
    return point;
}

Eigen::Vector3d beside(const Particles& particles, std::size_t slot,
                       const Eigen::Vector3d& offset) {
    return Eigen::Vector3d(particles.position[0][slot], particles.position[1][slot],
                           particles.position[2][slot]) +
           offset;
}

}  // namespace

Outline::Outline(const specimen::Shape& shape, const Packing& packing)
    : packing_(packing),
      layer_slots_(packing.slots_by_layer()),
      initial_length_(shape.length()),
      initial_rear_radius_(shape.rear_radius()) {
    const auto& stations = shape.station_height;
    std::size_t layer = 0;
    double section_radius = shape.rear_radius();
    for (std::size_t s = 0; s + 1 < stations.size(); ++s) {
        if (stations[s + 1] <= stations[s]) continue;
        const auto on_station = [&](std::size_t station, std::size_t of_layer) {
            if (packing.layers[of_layer].height == stations[station]) return;
            rings_.push_back(make_ring(of_layer, stations[station],
                                       shape.station_radius[station], false));
        };
        on_station(s, layer);
        const std::size_t first = layer;
        for (; layer < packing.layers.size() &&
               packing.layers[layer].low < stations[s + 1] - tolerance;
             ++layer) {
            const double height = packing.layers[layer].height;
            if (height < shape.head_length) transition_ring_ = rings_.size() + 1;
            const double radius =
                std::lerp(shape.station_radius[s], shape.station_radius[s + 1],
                          (height - stations[s]) / (stations[s + 1] - stations[s]));
            rings_.push_back(make_ring(layer, height, radius, layer > first));
        }
        rings_.back().smoothed = false;
        if (std::abs(stations[s + 1] - shape.head_length) < tolerance) {
            // The head's side of the section, but held by the rear, which hardly deforms
            // there: the gradients at the corner mix in those of the head, which drags
            // along the rear's lowest layer as well.
            on_station(s + 1, layer + 1);
            rings_.back().rigid = true;
            transition_ring_ = rings_.size() - 1;
            section_radius = shape.station_radius[s + 1];
        } else {
            on_station(s + 1, layer - 1);
        }
    }
    const auto above = std::find_if(
        packing.layers.begin(), packing.layers.end(),
        [&](const Layer& of_layer) { return of_layer.height >= shape.head_length; });
    section_ = divide_section(static_cast<std::size_t>(above - packing.layers.begin()),
                              shape.head_length, section_radius);
}

Outline::Ring Outline::make_ring(std::size_t layer, double height, double radius,
                                 bool smoothed) const {
    Ring ring{{}, smoothed, false};
    for (int a = 0; a < angles; ++a) {
        const double angle = 2 * std::numbers::pi * (a + 0.5) / angles;
        const double x = radius * std::cos(angle), y = radius * std::sin(angle);
        Tracer nearest{0, INFINITY, INFINITY, INFINITY};
        for (const std::size_t slot : layer_slots_[layer]) {
            const double dx = x - packing_.x[slot], dy = y - packing_.y[slot];
            if (std::hypot(dx, dy) < std::hypot(nearest.x, nearest.y)) {
                nearest = {slot, dx, dy, height - packing_.z[slot]};
            }
        }
        ring.tracers.push_back(nearest);
    }
    return ring;
}

/// By samples, as the particles' own patches end at the rear's flank and not at the
/// head's. The section is steep near its rim: a mean over the particles whose places lie
/// within it would depend by a per cent on where the lattice has them.
std::vector<Outline::Piece> Outline::divide_section(std::size_t layer, double height,
                                                    double radius) const {
    const std::vector<std::size_t>& slots = layer_slots_[layer];
    const double spacing = packing_.layers[layer].edge / samples_per_edge;
    const double rise = height - packing_.layers[layer].height;
    const int reach = static_cast<int>(std::ceil(radius / spacing));
    std::vector<Piece> pieces;
    pieces.reserve(slots.size());
    for (const std::size_t slot : slots) pieces.push_back({{slot, 0, 0, rise}, 0});
    double total = 0;
    std::vector<std::size_t> owners;
    for (int i = -reach; i < reach; ++i) {
        for (int j = -reach; j < reach; ++j) {
            const double x = (i + 0.5) * spacing, y = (j + 0.5) * spacing;
            if (std::hypot(x, y) >= radius) continue;
            // Equally near ones share a sample, which keeps the lattice's symmetry.
            double least = INFINITY;
            for (std::size_t k = 0; k < slots.size(); ++k) {
                const double dx = x - packing_.x[slots[k]];
                const double dy = y - packing_.y[slots[k]];
                const double square = dx * dx + dy * dy;
                if (square > least * (1 + alike)) continue;
                if (square < least * (1 - alike)) owners.clear();
                least = std::min(least, square);
                owners.push_back(k);
            }
            const double part = 1 / static_cast<double>(owners.size());
            for (const std::size_t k : owners) {
                pieces[k].share += part;
                pieces[k].middle.x += part * (x - packing_.x[slots[k]]);
                pieces[k].middle.y += part * (y - packing_.y[slots[k]]);
            }
            total += 1;
        }
    }
    std::erase_if(pieces, [](const Piece& piece) { return piece.share == 0; });
    for (Piece& piece : pieces) {
        piece.middle.x /= piece.share;
        piece.middle.y /= piece.share;
        piece.share /= total;
    }
    return pieces;
}

double Outline::section_height(const Particles& particles) const {
    double height = 0;
    for (const auto& [middle, share] : section_)
        height +=
            share * carried(particles, middle.slot, {middle.x, middle.y, middle.z}).z();
    return height;
}

double Outline::plane_height(const Particles& particles, std::size_t layer,
                             double height) const {
    const double rise = height - packing_.layers[layer].height;
    double sum = 0, volume = 0;
    for (const std::size_t slot : layer_slots_[layer]) {
        sum += packing_.volume[slot] * carried(particles, slot, {0, 0, rise}).z();
        volume += packing_.volume[slot];
    }
    return sum / volume;
}

observe::DeformedProfile Outline::measure(const Particles& particles) const {
    const std::size_t last = packing_.layers.size() - 1;
    const double face = plane_height(particles, 0, packing_.layers.front().low);

    observe::DeformedProfile profile;
    profile.initial_length = initial_length_;
    profile.initial_rear_radius = initial_rear_radius_;
    profile.total_length =
        plane_height(particles, last, packing_.layers[last].high) - face;
    profile.transition_height = section_height(particles) - face;

    std::vector<double> heights, radii;
    for (const Ring& ring : rings_) {
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        std::vector<Eigen::Vector3d> points;
        for (const Tracer& t : ring.tracers) {
            points.push_back(ring.rigid ? beside(particles, t.slot, {t.x, t.y, t.z})
                                        : carried(particles, t.slot, {t.x, t.y, t.z}));
            centre += points.back() / angles;
        }
        double square = 0;
        for (const Eigen::Vector3d& point : points) {
            square += (point - centre).head<2>().squaredNorm() / angles;
        }
        heights.push_back(centre.z() - face);
        radii.push_back(std::sqrt(square));
    }
    profile.outline_height = heights;
    profile.outline_radius = radii;
    // The two interlaced lattices alternate: 1-2-1 means keep straight lines as they are.
    for (std::size_t i = 1; i + 1 < rings_.size(); ++i) {
        if (!rings_[i].smoothed) continue;
        profile.outline_height[i] =
            (heights[i - 1] + 2 * heights[i] + heights[i + 1]) / 4;
        profile.outline_radius[i] = (radii[i - 1] + 2 * radii[i] + radii[i + 1]) / 4;
    }
    profile.head_points = transition_ring_ + 1;
    profile.transition_radius = profile.outline_radius[transition_ring_];
    return profile;
}

double Outline::contact_spot_radius(const Particles& particles) const {
    double x = 0, y = 0, squares = 0, volume = 0;
    for (const std::size_t slot : layer_slots_.front()) {
        const double v = packing_.volume[slot];
        const double px = particles.position[0][slot], py = particles.position[1][slot];
        volume += v;
        x += v * px;
        y += v * py;
        squares += v * (px * px + py * py);
    }
    return std::sqrt(2 * (squares - (x * x + y * y) / volume) / volume);
}

}  // namespace taylorcal::sph
