#pragma once

#include "solver/material/strength.hpp"

namespace taylorcal::material {

/// J2 plasticity with linear isotropic hardening: Y = Y0 + H eps, with
/// `j2_yield_stress` and `j2_hardening_modulus`; independent of rate and temperature.
template <class Real>
std::unique_ptr<Strength<Real>> make_j2(const Parameters& parameters, std::size_t grains);

}  // namespace taylorcal::material
