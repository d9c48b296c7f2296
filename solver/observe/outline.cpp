#include "solver/observe/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taylorcal::observe {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// Radius where the piece of outline from point i to i + 1 crosses `height`.
double radius_on_piece(const DeformedProfile& profile, std::size_t i, double height) {
    const double lower = profile.outline_height[i];
    const double rise = profile.outline_height[i + 1] - lower;
    if (rise == 0)
        return std::max(profile.outline_radius[i], profile.outline_radius[i + 1]);
    return std::lerp(profile.outline_radius[i], profile.outline_radius[i + 1],
                     (height - lower) / rise);
}

}  // namespace

const std::array<double, outline_points>& outline_fractions() {
    static const std::array<double, outline_points> fractions = [] {
        std::array<double, outline_points> values{};
        for (std::size_t i = 0; i < outline_points; ++i) {
            const double share = (static_cast<double>(i) + 0.5) / outline_points;
            values[i] = share * std::sqrt(share);
        }
        return values;
    }();
    return fractions;
}

double silhouette_radius(const DeformedProfile& profile, double height,
                         std::size_t points) {
    double largest = not_there;
    for (std::size_t i = 0; i + 1 < points; ++i) {
        const auto [low, high] =
            std::minmax(profile.outline_height[i], profile.outline_height[i + 1]);
        if (height >= low && height <= high)
            largest = std::fmax(largest, radius_on_piece(profile, i, height));
    }
    return largest;
}

std::vector<double> sample_outline(const DeformedProfile& profile) {
    std::vector<double> radii(outline_points, not_there);
    const std::vector<double>& heights = profile.outline_height;
    if (heights.size() < 2 || !std::isfinite(profile.total_length)) return radii;
    const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
    for (std::size_t i = 0; i < outline_points; ++i) {
        const double height =
            std::clamp(outline_fractions()[i] * profile.total_length, *lowest, *highest);
        radii[i] = silhouette_radius(profile, height, heights.size()) /
                   profile.initial_rear_radius;
    }
    return radii;
}

}  // namespace taylorcal::observe
