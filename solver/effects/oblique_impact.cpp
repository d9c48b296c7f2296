#include "solver/effects/effect.hpp"

#include <numbers>

namespace taylorcal::effects {

Effect oblique_impact() {
    return {
        .name = "oblique_impact",
        .symbol = "thetaA",
        .equation = "anvil's normal at thetaA to the specimen's axis and flight",
        .unit = "deg",
        .lowest = 0,
        .highest = 3,
        .prior = {PriorKind::half_normal, 1},
        .typical = 1,
        .is_signed = false,
        .acts_on = ActsOn::impact,
        .geometries = {impact::Geometry::three_dimensional},
        .needs_dislocations = false,
        .description = "tilted anvil: one side of the rim touches first",
        .source =
            "judgement, no source: no figure for the tilt of Taylor tests was found. "
            "Where computed, a 4-mm head topples at 5 degrees, so that the range ends "
            "below",
        .apply =
            [](impact::ImpactCase& impact_case, double degrees) {
                impact_case.additions.anvil_tilt = degrees * std::numbers::pi / 180;
            },
    };
}

}  // namespace taylorcal::effects
