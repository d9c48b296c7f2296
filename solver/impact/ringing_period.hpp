#pragma once

#include <cmath>

namespace taylorcal::impact {

/// Time in which a longitudinal wave runs up and down a specimen; SI units.
inline double ringing_period(double length, double bulk_modulus, double shear_modulus,
                             double density) {
    const double young =
        9 * bulk_modulus * shear_modulus / (3 * bulk_modulus + shear_modulus);
    return 2 * length / std::sqrt(young / density);
}

}  // namespace taylorcal::impact
