#pragma once

#include <string>
#include <vector>

namespace taylorcal::specimen {

enum class ProfileKind { cylinder, stepped, tapered };

/// What a name says of a specimen: shares of the rear's radius and of the total length.
struct Profile {
    ProfileKind kind = ProfileKind::cylinder;
    double end_radius = 1;      ///< of the end that hits the anvil
    double head_length = 0.25;  ///< up to the head-rear section, a material plane

    bool operator==(const Profile&) const = default;
};

/// The paper's four. The head of a uniform cylinder is its first quarter.
inline constexpr Profile uniform_cylinder;
inline constexpr Profile reduced_head_4mm{ProfileKind::stepped, 0.5, 0.25};
inline constexpr Profile reduced_head_3mm{ProfileKind::stepped, 0.375, 0.25};
inline constexpr Profile truncated_cone{ProfileKind::tapered, 0.25, 0.5};

/// A profile of revolution standing on the anvil at z = 0: radius r(z) between the
/// stations, piecewise linear; a step is two stations at one height. Lengths in m.
struct Shape {
    Profile profile;
    std::vector<double> station_height;
    std::vector<double> station_radius;
    double head_length = 0;  ///< height of the head-rear section

    double length() const { return station_height.back(); }
    double rear_radius() const { return station_radius.back(); }
    /// Radius at height z; at a step the value just above.
    double radius_at(double height) const;
};

/// "cylinder" and "cone" in full; every other name as it is.
std::string full_name(const std::string& name);

/// The profile that a name means: one of the paper's, or a reduced head or truncated cone
/// of other measures, "reduced_head_5mm_by_12mm" (end diameter and head length, of 8 mm x
/// 40 mm unless "_of_7.6mm_by_25.4mm" follows). InputError with the nearest name when it
/// means none, or when the end or the head are beyond what the meshes can hold.
Profile profile_named(const std::string& name);

/// `diameter` is that of the rear and `length` the total length [m]; all the rest keeps
/// its share of them.
Shape make_shape(const Profile& profile, double diameter = 8e-3, double length = 40e-3);

}  // namespace taylorcal::specimen
