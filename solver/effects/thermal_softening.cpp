#include "solver/effects/effect.hpp"

#include <algorithm>

namespace taylorcal::effects {

Effect thermal_softening() {
    return {
        .name = "thermal_softening",
        .symbol = "kappaT",
        .equation = "Ys (1 - kappaT (T - T0)/(Tm - T0)), T0 <= T <= Tm",
        .unit = "1",
        .lowest = 0,
        .highest = 1,
        .prior = {PriorKind::half_normal, 0.5},
        .typical = 0.3,
        .is_signed = false,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description =
            "slip resistance falls with temperature; 1 leaves none at melting (Tm is "
            "jc_melting_temperature, T0 reference_temperature)",
        .source =
            "OFHC copper of Johnson and Cook 1983: all strength lost at 1356 K, m = "
            "1.09, nearly the straight line of amplitude 1. The prior's width is a "
            "judgement",
        .apply =
            [](impact::ImpactCase& impact_case, double share) {
                material::check_melting_temperature(impact_case.material);
                const double cold = impact_case.material.reference_temperature;
                const double melting = impact_case.material.jc_melting_temperature;
                impact_case.additions.grains.slip_resistance.push_back(
                    [=](material::GrainBlock& grains) {
                        for (std::size_t i = 0; i < grains.lanes; ++i) {
                            const double homologous = std::clamp(
                                (grains.temperature[i] - cold) / (melting - cold), 0.0,
                                1.0);
                            grains.slip_resistance[i] *= 1 - share * homologous;
                        }
                    });
            },
    };
}

}  // namespace taylorcal::effects
