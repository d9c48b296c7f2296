#pragma once

#include "solver/sph/particles.hpp"

namespace taylorcal::sph {

/// How a particle's metal resists the motion that its corrected gradient misses.
template <class Vector>
struct MisfitResistance {
    Vector stiffness;   ///< kappa = hourglass coefficient x 2 G x edge^2 [Pa m2]
    Vector relaxation;  ///< 2 G (S : Dp)/(S : S), the rate at which slip relaxes S [1/s]
};

/// Moves the elastic misfit of a block for `step` [s]: du/dt = misfit rate - relaxation
/// u, as an elastic-plastic stress would, since damping alone lets the section of a head
/// collapse in motions that no stress sees. Sets the pulls q = kappa u and returns their
/// power per reference volume [W/m3].
template <class Vector>
Vector resist_misfit(Particles& particles, std::size_t block,
                     const MisfitResistance<Vector>& resistance, float step) {
    const Vector kept = lane_inverse(1 + step * resistance.relaxation);
    Vector power{};
    for (std::size_t r = 0; r < 3; ++r) {
        const Vector rate = particles.misfit_rate[r][block];
        const Vector before = particles.misfit_pull[r][block];
        const Vector misfit = (particles.elastic_misfit[r][block] + step * rate) * kept;
        const Vector pull = resistance.stiffness * misfit;
        power += 0.5f * (before + pull) * rate;
        particles.elastic_misfit[r][block] = misfit;
        particles.misfit_pull[r][block] = pull;
    }
    return power;
}

}  // namespace taylorcal::sph
