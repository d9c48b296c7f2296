#include "solver/effects/effect.hpp"

#include <cmath>

namespace taylorcal::effects {
namespace {

constexpr double activation_energy = 0.1;     // Q [eV]
constexpr double boltzmann = 8.617333262e-5;  // k [eV/K]
constexpr double room_temperature = 300;      // [K]

}  // namespace

Effect dynamic_recovery() {
    return {
        .name = "dynamic_recovery",
        .symbol = "k2",
        .equation =
            "drhoI/dt - k2 exp(Q/k (1/300 K - 1/T)) g rhoI, g the slip rate sum b rhoD "
            "V, Q = 0.1 eV",
        .unit = "1",
        .lowest = 0,
        .highest = 5,
        .prior = {PriorKind::half_normal, 1},
        .typical = 0.5,
        .is_signed = false,
        .acts_on = ActsOn::material,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description =
            "thermally activated loss of immobilized dislocations while the grain slips",
        .source =
            "Follansbee and Kocks 1988, copper: k2 = 2 theta0/tau_s is 3 at 300 K, and "
            "at 700 K 1.3 (1e4 1/s) to 2.3 times more (1e-3 1/s), as Q = 0.01 to 0.04 eV "
            "has it. Q = 0.1 eV is a judgement above that (9 times), and so is a prior "
            "of a third of 3, since Eqs. 15-19 annihilate already",
        .apply =
            [](impact::ImpactCase& impact_case, double coefficient) {
                const double burgers_vector = impact_case.material.burgers_vector;
                impact_case.additions.grains.densities.push_back(
                    [=](material::GrainBlock& grains) {
                        for (std::size_t i = 0; i < grains.lanes; ++i) {
                            double slip = 0;
                            for (std::size_t d = 0; d < grains.mobile.size(); ++d)
                                slip += burgers_vector * grains.mobile[d][i] *
                                        grains.slip_speed[d][i] * grains.duration;
                            const double activation = std::exp(
                                activation_energy / boltzmann *
                                (1 / room_temperature - 1 / grains.temperature[i]));
                            const double kept =
                                std::exp(-coefficient * activation * slip);
                            for (auto& immobile : grains.immobile) immobile[i] *= kept;
                        }
                    });
            },
    };
}

}  // namespace taylorcal::effects
