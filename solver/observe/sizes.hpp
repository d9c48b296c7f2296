#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace taylorcal::observe {

/// A deformed specimen as both geometries describe it, lengths in m. The outline follows
/// the free surface from the rim of the impact face to the rim of the rear face
/// (r(z) may fold back near the foot); heights are measured from the impact face.
struct DeformedProfile {
    std::vector<double> outline_height;
    std::vector<double> outline_radius;
    std::size_t head_points = 0;  ///< first outline points, on the head; 0: all
    double total_length = 0;
    double transition_height = 0;  ///< mean height of the head-rear material plane
    double transition_radius = 0;  ///< its outline's radius
    double initial_length = 0;
    double initial_rear_radius = 0;
};

/// The measured sizes [mm]; NaN where a size has no meaning.
struct Sizes {
    double final_length_mm;
    double
        impact_diameter_mm;  ///< 2 x largest radius of the head within 2 mm of the anvil
    double head_length_mm;
    double rear_length_mm;
    double transition_diameter_mm;
    double undeformed_length_mm;  ///< rear part within 0.5 % of its first diameter
    double diameter_at_0p2L0_mm;  ///< at 0.2 x initial length above the impact face
};

Sizes measure(const DeformedProfile& profile);

/// The head's largest radius between the anvil and 2 mm above it, where the piece of
/// outline that leaves this zone is cut [m]. The rear is not read: its shoulder sinks
/// into the zone as a head collapses, and the size would jump.
double foot_radius(const DeformedProfile& profile);

/// "final_length_mm" ... in the order of the struct, and the values in that order.
const std::vector<std::string>& size_names();
std::vector<double> size_values(const Sizes& sizes);

}  // namespace taylorcal::observe
