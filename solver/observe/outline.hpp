#pragma once

#include "solver/observe/sizes.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace taylorcal::observe {

/// Heights at which the outline is kept, over the final length: rising within (0, 1), as
/// ((i + 1/2) / 40)^(3/2), so that half of them lie in the lower 35 %, where it bends.
inline constexpr std::size_t outline_points = 40;
const std::array<double, outline_points>& outline_fractions();

/// The silhouette's radius [m] at a height [m] of the first `points` of the outline: the
/// largest where a folded outline crosses it several times, as a calliper reads it. NaN
/// where these points do not reach.
double silhouette_radius(const DeformedProfile& profile, double height,
                         std::size_t points);

/// The silhouette at outline_fractions() x total length, over the initial radius of the
/// rear. Below the lowest and above the highest point of the outline (a rim that has
/// curled up, a rear face that is not flat) the nearest height that it reaches counts.
/// All NaN where there is no outline.
std::vector<double> sample_outline(const DeformedProfile& profile);

}  // namespace taylorcal::observe
