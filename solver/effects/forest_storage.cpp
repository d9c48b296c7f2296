#include "solver/effects/effect.hpp"

#include <cmath>

namespace taylorcal::effects {

Effect forest_storage() {
    return {
        .name = "forest_storage",
        .symbol = "kF",
        .equation =
            "QI + kF V rhoD sqrt(sum rhoI): k1 = kF/b of "
            "Kocks and Mecking",
        .unit = "1",
        .lowest = 0,
        .highest = 0.05,
        .prior = {PriorKind::half_normal, 0.007},
        .typical = 0.002,
        .is_signed = false,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description =
            "gliding dislocations are stored at the forest (Kocks and Mecking)",
        .source =
            "the law: Kocks and Mecking 2003. Slope of the copper of Follansbee and "
            "Kocks 1988: 2307 to 2670 MPa in tension (1e-3 to 1e4 1/s), by a Taylor "
            "factor of 3.06 G/183 to G/158 in shear (G = 45 GPa); kF = 4/AI of that is "
            "0.008 to 0.009 at AI = 2.8, and 0.007 for the usual G/200. Range: judgement",
        .apply =
            [](impact::ImpactCase& impact_case, double coefficient) {
                impact_case.additions.grains.densities.push_back(
                    [=](material::GrainBlock& grains) {
                        for (std::size_t i = 0; i < grains.lanes; ++i) {
                            double forest = 0;
                            for (const auto& immobile : grains.immobile)
                                forest += immobile[i];
                            const double path_rate = coefficient * std::sqrt(forest);
                            for (std::size_t d = 0; d < grains.mobile.size(); ++d) {
                                const double path =
                                    grains.slip_speed[d][i] * grains.duration;
                                const double stored =
                                    -std::expm1(-path_rate * path) * grains.mobile[d][i];
                                grains.mobile[d][i] -= stored;
                                grains.immobile[d][i] += stored;
                            }
                        }
                    });
            },
    };
}

}  // namespace taylorcal::effects
