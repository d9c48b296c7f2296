#include "solver/observe/sizes.hpp"

#include "solver/observe/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taylorcal::observe {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double foot_zone = 2e-3;           // height read as the foot [m]
constexpr double undeformed_change = 0.005;  // of the radius
constexpr double low_section = 0.2;  // height of the low diameter / initial length

/// Radii with isolated outliers removed: the median of three neighbours changes no
/// monotone stretch, so edges and steps stay where they are.
std::vector<double> without_outliers(const std::vector<double>& radius) {
    std::vector<double> smooth = radius;
    for (std::size_t i = 1; i + 1 < radius.size(); ++i) {
        const auto [low, high] = std::minmax(radius[i - 1], radius[i + 1]);
        smooth[i] = std::clamp(radius[i], low, high);
    }
    return smooth;
}

/// Length of the rear part, contiguous from the rear face, that keeps its first radius.
double undeformed_length(const DeformedProfile& profile) {
    const std::vector<double> radius = without_outliers(profile.outline_radius);
    const auto& height = profile.outline_height;
    const auto change = [&](std::size_t i) {
        return std::abs(radius[i] / profile.initial_rear_radius - 1);
    };
    std::size_t i = radius.size() - 1;
    if (change(i) > undeformed_change) return 0;
    while (i > 0 && change(i - 1) <= undeformed_change) --i;
    if (i == 0) return profile.total_length;
    const double share = (undeformed_change - change(i)) / (change(i - 1) - change(i));
    return profile.total_length - std::lerp(height[i], height[i - 1], share);
}

}  // namespace

double foot_radius(const DeformedProfile& profile) {
    const std::size_t points =
        profile.head_points > 0 ? profile.head_points : profile.outline_height.size();
    double largest = silhouette_radius(profile, foot_zone, points);
    for (std::size_t i = 0; i < points; ++i)
        if (profile.outline_height[i] <= foot_zone)
            largest = std::fmax(largest, profile.outline_radius[i]);
    return largest;
}

Sizes measure(const DeformedProfile& profile) {
    constexpr double to_mm = 1e3;
    Sizes sizes{nan, nan, nan, nan, nan, nan, nan};
    if (profile.outline_height.size() < 2 || !std::isfinite(profile.total_length))
        return sizes;
    sizes.final_length_mm = to_mm * profile.total_length;
    sizes.impact_diameter_mm = to_mm * 2 * foot_radius(profile);
    sizes.head_length_mm = to_mm * profile.transition_height;
    sizes.rear_length_mm = to_mm * (profile.total_length - profile.transition_height);
    sizes.transition_diameter_mm = to_mm * 2 * profile.transition_radius;
    sizes.undeformed_length_mm = to_mm * undeformed_length(profile);
    sizes.diameter_at_0p2L0_mm =
        to_mm * 2 *
        silhouette_radius(profile, low_section * profile.initial_length,
                          profile.outline_height.size());
    return sizes;
}

const std::vector<std::string>& size_names() {
    static const std::vector<std::string> names = {
        "final_length_mm",     "impact_diameter_mm",     "head_length_mm",
        "rear_length_mm",      "transition_diameter_mm", "undeformed_length_mm",
        "diameter_at_0p2L0_mm"};
    return names;
}

std::vector<double> size_values(const Sizes& sizes) {
    return {sizes.final_length_mm,        sizes.impact_diameter_mm,
            sizes.head_length_mm,         sizes.rear_length_mm,
            sizes.transition_diameter_mm, sizes.undeformed_length_mm,
            sizes.diameter_at_0p2L0_mm};
}

}  // namespace taylorcal::observe
