#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taylorcal::specimen {

enum class ShapeKind {
    uniform_cylinder,
    reduced_head_4mm,
    reduced_head_3mm,
    truncated_cone
};

/// A profile of revolution standing on the anvil at z = 0: radius r(z) between the
/// stations, piecewise linear; a step is two stations at one height. Lengths in m.
struct Shape {
    ShapeKind kind = ShapeKind::uniform_cylinder;
    std::vector<double> station_height;
    std::vector<double> station_radius;
    double head_length = 0;  ///< height of the head-rear section, a material plane

    double length() const { return station_height.back(); }
    double rear_radius() const { return station_radius.back(); }
    /// Radius at height z; at a step the value just above.
    double radius_at(double height) const;
};

/// The words users write, in the order of the paper's code 0-3: uniform_cylinder,
/// reduced_head_4mm, reduced_head_3mm, truncated_cone.
const std::vector<std::string>& shape_names();
std::string shape_name(ShapeKind kind);
/// InputError with the nearest name when unknown ("cone" and "cylinder" are understood).
ShapeKind shape_from_name(std::string_view name);

/// One of the four. `diameter` is that of the rear and `length` the total length [m]; the
/// profile scales with them from the paper's 8 mm x 40 mm (head lengths and head or tip
/// radii in proportion). The head of a uniform cylinder is its first quarter.
Shape make_shape(ShapeKind kind, double diameter = 8e-3, double length = 40e-3);

}  // namespace taylorcal::specimen
