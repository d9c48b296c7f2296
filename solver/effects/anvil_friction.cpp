#include "solver/effects/effect.hpp"

namespace taylorcal::effects {

Effect anvil_friction() {
    return {
        .name = "anvil_friction",
        .symbol = "muA",
        .equation = "tau = muA p at the anvil, against the sliding, until it stops",
        .unit = "1",
        .lowest = 0,
        .highest = 0.5,
        .prior = {PriorKind::half_normal, 0.1},
        .typical = 0.05,
        .is_signed = false,
        .acts_on = ActsOn::anvil,
        .geometries = both_geometries,
        .needs_dislocations = false,
        .description = "Coulomb friction of the impact face on the anvil",
        .source =
            "Rodionov 2023: 0.05 and above contradict the measured shape (uniform "
            "cylinder, 117.6 m/s). Tables of slow dry sliding, copper on steel: 0.21 to "
            "0.36, at rest 0.23 to 0.53. The prior's width is a judgement",
        .apply =
            [](impact::ImpactCase& impact_case, double friction) {
                impact_case.additions.friction_coefficient = friction;
            },
    };
}

}  // namespace taylorcal::effects
