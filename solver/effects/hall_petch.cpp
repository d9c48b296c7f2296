#include "solver/effects/effect.hpp"
#include "solver/material/microstructure.hpp"

#include <cmath>

namespace taylorcal::effects {

Effect hall_petch() {
    return {
        .name = "hall_petch",
        .symbol = "kHP",
        .equation = "Ys + kHP (1/sqrt(d) - 1/sqrt(d0)), d by Eq. 22",
        .unit = "MPa m^0.5",
        .lowest = 0,
        .highest = 0.5,
        .prior = {PriorKind::half_normal, 0.12},
        .typical = 0.12,
        .is_signed = false,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description = "hardening by the boundaries that grain refinement makes",
        .source =
            "the law: Hall 1951, Petch 1953 (reviewed by Naik and Walley 2020). 0.12 MPa "
            "m^0.5 is quoted for copper in tension (Smith and Hashemi 2006, not "
            "checked); as Ys is the tensile stress over 1.53 (Taylor factor 3.06, "
            "threshold Ys/2), kHP would be 0.08. Range: judgement",
        .apply =
            [](impact::ImpactCase& impact_case, double coefficient) {
                const material::Parameters parameters = impact_case.material;
                impact_case.additions.grains.slip_resistance.push_back(
                    [=](material::GrainBlock& grains) {
                        const double before =
                            1 / std::sqrt(parameters.initial_grain_diameter);
                        for (std::size_t i = 0; i < grains.lanes; ++i) {
                            const double diameter =
                                grain_diameter(parameters, grains.annihilated_energy[i]);
                            grains.slip_resistance[i] +=
                                1e6 * coefficient * (1 / std::sqrt(diameter) - before);
                        }
                    });
            },
    };
}

}  // namespace taylorcal::effects
