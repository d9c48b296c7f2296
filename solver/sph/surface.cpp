#include "solver/sph/surface.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace taylorcal::sph {

namespace {

// Of the outermost particles below the surface, in local edges: sites that would own
// little of their tile have given it to them.
constexpr double deepest = 0.85;
constexpr double tolerance = 1e-9;  // between heights that are meant to be one [m]

/// The stretch of the profile that holds a layer.
std::size_t stretch_of(const specimen::Shape& shape, const Layer& layer) {
    std::size_t lower = 0;
    while (shape.station_height[lower + 1] < layer.high - tolerance ||
           shape.station_height[lower + 1] <= shape.station_height[lower])
        ++lower;
    return lower;
}

}  // namespace

std::vector<SurfaceElement> surface_elements(const specimen::Shape& shape,
                                             const Packing& packing) {
    const std::vector<std::vector<std::size_t>> slots = packing.slots_by_layer();
    std::vector<SurfaceElement> elements;
    for (std::size_t l = 0; l < packing.layers.size(); ++l) {
        const Layer& layer = packing.layers[l];
        const std::size_t lower = stretch_of(shape, layer);
        const double bottom = shape.station_height[lower];
        const double slope =
            (shape.station_radius[lower + 1] - shape.station_radius[lower]) /
            (shape.station_height[lower + 1] - bottom);
        const double radius =
            shape.station_radius[lower] + slope * (layer.height - bottom);
        const double tilt = 1 / std::hypot(1, slope);
        const bool above_step = lower > 0 && layer.low < bottom + tolerance &&
                                shape.station_height[lower - 1] == bottom;
        for (const std::size_t slot : slots[l]) {
            const double x = packing.x[slot], y = packing.y[slot];
            const double r = std::hypot(x, y);
            const double depth = tilt * (radius - r);
            if (depth < deepest * layer.edge && r > 0) {
                elements.push_back({slot, tilt * Eigen::Vector3d(x / r, y / r, -slope),
                                    std::max(depth, 0.0)});
            }
            if (above_step && r > shape.station_radius[lower - 1]) {
                elements.push_back(
                    {slot, -Eigen::Vector3d::UnitZ(), layer.height - layer.low});
            }
        }
    }
    return elements;
}

DeformedElement deform(const SurfaceElement& element, const Packing& packing,
                       const Particles& particles) {
    Eigen::Matrix3d gradient;
    for (std::size_t c = 0; c < 9; ++c) {
        gradient(static_cast<Eigen::Index>(c / 3), static_cast<Eigen::Index>(c % 3)) =
            particles.deformation[c][element.slot];
    }
    const Eigen::Matrix3d inverse = gradient.inverse();
    const Eigen::Vector3d normal = inverse.transpose() * element.normal;
    const double squeeze = normal.norm();
    return {inverse / packing.local_edge[element.slot], normal / squeeze,
            element.depth / squeeze};
}

}  // namespace taylorcal::sph
