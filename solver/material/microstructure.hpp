#pragma once

#include "solver/material/parameters.hpp"

namespace taylorcal::material {

inline constexpr double electron_volt = 1.602176634e-19;  // [J]

/// Grain diameter d = 1/(1/d0 + etaGB J/(3 gammaGB)) [m] after the annihilated energy
/// J [J/m3], Eq. 22.
inline double grain_diameter(const Parameters& p, double annihilated_energy) {
    return 1 /
           (1 / p.initial_grain_diameter +
            p.boundary_energy_fraction * annihilated_energy / (3 * p.boundary_energy));
}

/// Weakened volume fraction alpha = D (1 - etaGB) J/(6 b epsS n0), Eq. 24.
inline double weakened_fraction(const Parameters& p, double annihilated_energy) {
    return p.weakened_zone_diameter * (1 - p.boundary_energy_fraction) *
           annihilated_energy /
           (6 * p.burgers_vector * p.stacking_energy * electron_volt * p.atomic_density);
}

}  // namespace taylorcal::material
