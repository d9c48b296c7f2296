#include "solver/effects/effect.hpp"

namespace taylorcal::effects {

Effect phonon_drag() {
    return {
        .name = "phonon_drag",
        .symbol = "kappaB",
        .equation = "B(T) (1 + kappaB)",
        .unit = "1",
        .lowest = -0.8,
        .highest = 4,
        .prior = {PriorKind::normal, 0.5},
        .typical = 1,
        .is_signed = true,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description = "phonon drag on dislocations differs from the table's",
        .source =
            "measurements and calculations for copper differ by a factor of two (Kumar "
            "and "
            "Kumble 1969; Jassby and Vreeland 1970; Blaschke 2019)",
        .apply =
            [](impact::ImpactCase& impact_case, double excess) {
                impact_case.material.drag_constant *= 1 + excess;
                impact_case.material.drag_slope *= 1 + excess;
            },
    };
}

}  // namespace taylorcal::effects
