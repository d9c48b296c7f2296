#pragma once

#include "solver/material/strength.hpp"

namespace taylorcal::material {

/// Johnson and Cook (1983): Y = (A + B eps^n) (1 + C ln(rate / 1 s^-1)) (1 - T*^m), with
/// T* = (T - T0)/(Tm - T0); the rate factor is 1 below 1 s^-1, and no strength is left at
/// melting. Parameters `jc_a` ... `jc_m`, `jc_melting_temperature`,
/// `reference_temperature`.
template <class Real>
std::unique_ptr<Strength<Real>> make_johnson_cook(const Parameters& parameters,
                                                  std::size_t grains);

}  // namespace taylorcal::material
