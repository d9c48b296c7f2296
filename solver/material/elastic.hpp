#pragma once

#include "solver/material/strength.hpp"

namespace taylorcal::material {

/// Isotropic hypoelastic deviator that never yields, for verification.
template <class Real>
std::unique_ptr<Strength<Real>> make_elastic(const Parameters& parameters,
                                             std::size_t grains);

}  // namespace taylorcal::material
