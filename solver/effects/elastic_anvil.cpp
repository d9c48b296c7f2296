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
            "the anvil yields elastically: 1 is plane waves radiated into steel, nearly "
            "what a rod of the specimen's width gives; less in a wide block, that "
            "supports the spot",
        .source =
            "judgement. Waves in steel: 5900 m/s (5870 to 5920 in tables). Estimate for "
            "a thick block: under a spot of 4 mm radius a half space (E = 210 GPa) "
            "yields at most what plane waves do in 1.4 us, a share of 0.14 after 10 us "
            "and 0.03 after 50 us. Forde et al. 2009: no anvil is rigid",
        .apply =
            [](impact::ImpactCase& impact_case, double share) {
                impact_case.additions.anvil_compliance = share / steel_impedance;
            },
    };
}

}  // namespace taylorcal::effects
