#include "calibrate/likelihood/spread_levels.hpp"

#include <cmath>
#include <limits>

namespace taylorcal::calibrate {
namespace {

/// Half-normal probability of [low, high], both from the tail so that it keeps its
/// digits.
double half_normal_mass(double low, double high, double scale) {
    const double root2 = std::sqrt(2.0);
    return std::erfc(low / (scale * root2)) - std::erfc(high / (scale * root2));
}

}  // namespace

SpreadLevels unexplained_spread_levels(const UnexplainedSpread& spread) {
    SpreadLevels levels;
    levels.name = "unexplained_spread";
    levels.values = spread.grid;
    const std::size_t n = spread.grid.size();
    levels.edges.push_back(0);
    for (std::size_t i = 1; i < n; ++i)
        levels.edges.push_back(0.5 * (spread.grid[i - 1] + spread.grid[i]));
    levels.edges.push_back(2 * spread.grid.back() - levels.edges.back());
    for (std::size_t i = 0; i < n; ++i) {
        const double high =
            i + 1 < n ? levels.edges[i + 1] : std::numeric_limits<double>::infinity();
        // The floor keeps a level of vanishing prior mass finite.
        const double mass = half_normal_mass(levels.edges[i], high, spread.prior_scale);
        levels.log_mass.push_back(std::log(std::max(mass, 1e-300)));
    }
    return levels;
}

SpreadLevels relative_sigma_levels() {
    constexpr int count = 61;
    constexpr double decades_per_level = 0.05;
    SpreadLevels levels;
    levels.name = "relative_sigma";
    for (int i = 0; i < count; ++i) {
        levels.values.push_back(std::pow(10.0, -3 + decades_per_level * i));
        levels.log_mass.push_back(-std::log(static_cast<double>(count)));
    }
    for (int i = 0; i <= count; ++i)
        levels.edges.push_back(std::pow(10.0, -3 + decades_per_level * (i - 0.5)));
    return levels;
}

SpreadLevels spread_levels(const Settings& settings) {
    if (settings.likelihood == LikelihoodForm::paper) return relative_sigma_levels();
    if (settings.unexplained_spread)
        return unexplained_spread_levels(*settings.unexplained_spread);
    return {"", {0.0}, {0.0, 0.0}, {0.0}};
}

}  // namespace taylorcal::calibrate
