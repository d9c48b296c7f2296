#include "solver/specimen/shape.hpp"

#include "common/errors.hpp"
#include "common/json_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace taylorcal::specimen {
namespace {

/// A profile of the paper in units of its rear radius and total length (MODEL.md).
struct Proportions {
    std::vector<double> height;
    std::vector<double> radius;
    double head;
};

Proportions proportions(ShapeKind kind) {
    switch (kind) {
        case ShapeKind::reduced_head_4mm:
            return {{0, 0.25, 0.25, 1}, {0.5, 0.5, 1, 1}, 0.25};
        case ShapeKind::reduced_head_3mm:
            return {{0, 0.25, 0.25, 1}, {0.375, 0.375, 1, 1}, 0.25};
        case ShapeKind::truncated_cone:
            return {{0, 0.5, 1}, {0.25, 1, 1}, 0.5};
        case ShapeKind::uniform_cylinder:
            break;
    }
    return {{0, 1}, {1, 1}, 0.25};
}

}  // namespace

double Shape::radius_at(double height) const {
    const auto above =
        std::upper_bound(station_height.begin(), station_height.end(), height);
    if (above == station_height.begin()) return station_radius.front();
    if (above == station_height.end()) return station_radius.back();
    const auto upper = static_cast<std::size_t>(above - station_height.begin());
    const std::size_t lower = upper - 1;
    const double share = (height - station_height[lower]) /
                         (station_height[upper] - station_height[lower]);
    return station_radius[lower] +
           share * (station_radius[upper] - station_radius[lower]);
}

const std::vector<std::string>& shape_names() {
    static const std::vector<std::string> names = {"uniform_cylinder", "reduced_head_4mm",
                                                   "reduced_head_3mm", "truncated_cone"};
    return names;
}

std::string shape_name(ShapeKind kind) {
    return shape_names()[static_cast<std::size_t>(kind)];
}

ShapeKind shape_from_name(std::string_view name) {
    if (name == "cylinder") return ShapeKind::uniform_cylinder;
    if (name == "cone") return ShapeKind::truncated_cone;
    const auto& names = shape_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<ShapeKind>(found - names.begin());
    std::vector<std::string> understood = {"cylinder", "cone"};
    understood.insert(understood.end(), names.begin(), names.end());
    const std::string near = nearest_word(name, understood);
    throw InputError(fmt::format("shape \"{}\" is unknown{}. Use one of: {}.", name,
                                 near.empty() ? "" : " (did you mean \"" + near + "\"?)",
                                 fmt::join(names, ", ")));
}

Shape make_shape(ShapeKind kind, double diameter, double length) {
    require(
        diameter > 0 && length > 0,
        fmt::format("specimen of diameter {} m and length {} m (both must be positive)",
                    diameter, length));
    const Proportions unit = proportions(kind);
    Shape shape;
    shape.kind = kind;
    for (const double height : unit.height)
        shape.station_height.push_back(height * length);
    for (const double radius : unit.radius)
        shape.station_radius.push_back(radius * diameter / 2);
    shape.head_length = unit.head * length;
    return shape;
}

}  // namespace taylorcal::specimen
