#include "solver/effects/effect.hpp"

namespace taylorcal::effects {

Effect back_stress() {
    return {
        .name = "back_stress",
        .symbol = "HX",
        .equation = "F = b M : (S - X), X = 2/3 HX w",
        .unit = "MPa",
        .lowest = 0,
        .highest = 1000,
        .prior = {PriorKind::half_normal, 200},
        .typical = 100,
        .is_signed = false,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description =
            "linear kinematic hardening: slip is driven by the stress less a back stress "
            "that grows with the plastic strain of the grain",
        .source =
            "the law: Prager. Bound: slope of the whole stress of copper after Johnson "
            "and Cook 1983 (B n e^(n-1), B = 292 MPa, n = 0.31): 1000 MPa at a strain e "
            "of 0.03, 200 at 0.3, 90 at 1. Which part of it is kinematic is a judgement, "
            "no source",
        .apply =
            [](impact::ImpactCase& impact_case, double modulus_mpa) {
                impact_case.additions.grains.back_stress.push_back(
                    [=](material::GrainBlock& grains) {
                        for (std::size_t k = 0; k < 5; ++k)
                            for (std::size_t i = 0; i < grains.lanes; ++i)
                                grains.back_stress[k][i] += 2.0 / 3 * 1e6 * modulus_mpa *
                                                            grains.plastic_strain[k][i];
                    });
            },
    };
}

}  // namespace taylorcal::effects
