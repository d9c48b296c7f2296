#include "solver/effects/effect.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::effects {
namespace {

constexpr double skin_depth = 0.2e-3;  // over which the excess falls by e [m]

/// From a place (r, z) to the piece of outline between two stations [m].
double distance_to_piece(double r, double z, double r0, double z0, double r1, double z1) {
    const double dr = r1 - r0, dz = z1 - z0;
    const double square = dr * dr + dz * dz;
    const double along =
        square > 0 ? std::clamp(((r - r0) * dr + (z - z0) * dz) / square, 0.0, 1.0) : 0;
    return std::hypot(r - r0 - along * dr, z - z0 - along * dz);
}

/// Below the turned surface: impact face, flanks and rear face [m].
double depth_below_surface(const specimen::Shape& shape, double r, double z) {
    double depth = std::min(std::abs(z), std::abs(shape.length() - z));
    for (std::size_t i = 0; i + 1 < shape.station_height.size(); ++i)
        depth = std::min(
            depth,
            distance_to_piece(r, z, shape.station_radius[i], shape.station_height[i],
                              shape.station_radius[i + 1], shape.station_height[i + 1]));
    return depth;
}

}  // namespace

Effect hard_skin() {
    return {
        .name = "hard_skin",
        .symbol = "kappaS",
        .equation = "rhoI(0) 10^(kappaS exp(-depth / 0.2 mm))",
        .unit = "dex",
        .lowest = 0,
        .highest = 3,
        .prior = {PriorKind::half_normal, 1},
        .typical = 1.5,
        .is_signed = false,
        .acts_on = ActsOn::initial_state,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description =
            "the tool has work-hardened the surface, the skin decays over 0.2 mm",
        .source =
            "judgement, no measured skin of turned copper was found. 1.5 dex make "
            "annealed strip a hard one (0.2 % proof stress 48 and 265 MPa, Smithells, "
            "Table 22.7; density as the square of stress); a rod that is hard already "
            "has less to gain. The depth is assumed",
        .apply =
            [](impact::ImpactCase& impact_case, double excess_dex) {
                const specimen::Shape shape = impact_case.shape;
                impact_case.additions.initial_density.push_back([=](double r, double z) {
                    const double depth = depth_below_surface(shape, r, z);
                    return std::pow(10, excess_dex * std::exp(-depth / skin_depth));
                });
            },
    };
}

}  // namespace taylorcal::effects
