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
        .source = "Rittel 2017: 0.3 to 0.9 for metals at high rates (copper 0.6 to 0.9)",
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
