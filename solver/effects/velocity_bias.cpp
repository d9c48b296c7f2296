#include "solver/effects/effect.hpp"

namespace taylorcal::effects {

Effect velocity_bias() {
    return {
        .name = "velocity_bias",
        .symbol = "kappaV",
        .equation = "true velocity = stated velocity (1 + kappaV)",
        .unit = "1",
        .lowest = -0.1,
        .highest = 0.1,
        .prior = {PriorKind::normal, 0.01},
        .typical = 0.02,
        .is_signed = true,
        .acts_on = ActsOn::impact,
        .geometries = both_geometries,
        .needs_dislocations = false,
        .description =
            "calibration error of the velocity measurement, the same for all shots",
        .source =
            "judgement, no source: 1 %, as the velocity error of a shot that states none",
        .apply = [](impact::ImpactCase& impact_case,
                    double share) { impact_case.velocity_m_s *= 1 + share; },
    };
}

}  // namespace taylorcal::effects
