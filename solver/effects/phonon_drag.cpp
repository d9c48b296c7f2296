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
            "measured, edge dislocations in pure copper, torsion of single crystals "
            "(thesis, California Institute of Technology): 20 m/s at 1.63 MPa and 296 K, "
            "hence B = 2.1e-5 Pa s, 1.7 times the B of Eqs. 12-14. Range and prior's "
            "width: judgement",
        .apply =
            [](impact::ImpactCase& impact_case, double excess) {
                impact_case.material.drag_constant *= 1 + excess;
                impact_case.material.drag_slope *= 1 + excess;
            },
    };
}

}  // namespace taylorcal::effects
