#include "solver/effects/effect.hpp"

namespace taylorcal::effects {
namespace {

constexpr double steel_impedance = 7850 * 5900;  // rho c [kg/m2/s]

}  // namespace

Effect elastic_anvil() {
    return {
        .name = "elastic_anvil",
        .symbol = "kappaZ",
        .equation = "the face recedes at kappaZ p/(rho c), rho c = 7850 x 5900 kg/m2/s",
        .unit = "1",
        .lowest = 0,
        .highest = 1,
        .prior = {PriorKind::half_normal, 0.1},
        .typical = 0.1,
        .is_signed = false,
        .acts_on = ActsOn::anvil,
        .geometries = both_geometries,
        .needs_dislocations = false,
        .description =
            "the anvil yields elastically: 1 is plane waves radiated into steel, which a "
            "rod "
            "of the specimen's width gives; less in a wide block, that supports the spot",
        .source =
            "plane waves in steel; a block of ten times the width holds a tenth and less "
            "of "
            "it after the first microsecond (half space, Johnson 1985)",
        .apply =
            [](impact::ImpactCase& impact_case, double share) {
                impact_case.additions.anvil_compliance = share / steel_impedance;
            },
    };
}

}  // namespace taylorcal::effects
