#include "common/errors.hpp"
#include "solver/effects/effect.hpp"

#include <fmt/core.h>

namespace taylorcal::effects {

Effect taylor_quinney_shift() {
    return {
        .name = "taylor_quinney_shift",
        .symbol = "kappaQ",
        .equation = "heat = (beta - kappaQ) S : wdot, in Eq. 3 only",
        .unit = "1",
        .lowest = 0,
        .highest = 0.6,
        .prior = {PriorKind::half_normal, 0.2},
        .typical = 0.3,
        .is_signed = false,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = false,
        .description = "less of the plastic work heats; the rest stays in the metal",
        .source =
            "Soares and Hokka 2021, titanium, iron, copper and tin at 1200 to 3100 1/s: "
            "0.2 to 0.7 of the work heats at first, 0.8 to 0.9 at larger strain, copper "
            "at the high end. The prior's width is a judgement",
        .apply =
            [](impact::ImpactCase& impact_case, double share) {
                const double most = impact_case.material.taylor_quinney;
                require(
                    share <= most,
                    fmt::format("effect taylor_quinney_shift = {} (expected at most the "
                                "taylor_quinney of {}). Lower it.",
                                share, most));
                impact_case.additions.unheated_share = share;
            },
    };
}

}  // namespace taylorcal::effects
