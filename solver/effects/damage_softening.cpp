#include "solver/effects/effect.hpp"
#include "solver/material/microstructure.hpp"

#include <algorithm>

namespace taylorcal::effects {

Effect damage_softening() {
    return {
        .name = "damage_softening",
        .symbol = "kappaD",
        .equation = "Ys (1 - kappaD alpha), alpha by Eq. 24, not below zero",
        .unit = "1",
        .lowest = 0,
        .highest = 2,
        .prior = {PriorKind::half_normal, 1},
        .typical = 1,
        .is_signed = false,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description =
            "the weakened volume fraction carries less; at 1 it carries nothing",
        .source =
            "Rodionov 2023: Eq. 24, up to 35 % (3-mm head at 122 m/s); 1 is the rule of "
            "mixtures. That weakened volume carries less, range and prior are a "
            "judgement, no source",
        .apply =
            [](impact::ImpactCase& impact_case, double loss) {
                const material::Parameters parameters = impact_case.material;
                impact_case.additions.grains.slip_resistance.push_back(
                    [=](material::GrainBlock& grains) {
                        for (std::size_t i = 0; i < grains.lanes; ++i) {
                            const double weakened = weakened_fraction(
                                parameters, grains.annihilated_energy[i]);
                            grains.slip_resistance[i] *=
                                std::max(1 - loss * weakened, 0.0);
                        }
                    });
            },
    };
}

}  // namespace taylorcal::effects
