#pragma once

#include "solver/effects/effect_list.hpp"
#include "solver/impact/simulate.hpp"

#include <string>

namespace taylorcal::testing {

/// `impact_case` with one effect.
inline impact::ImpactCase with_effect(const std::string& name, double amplitude,
                                      impact::ImpactCase impact_case = {}) {
    effects::Amplitudes amplitudes;
    effects::set_amplitude(amplitudes, name, amplitude);
    effects::apply_effects(amplitudes, impact_case);
    return impact_case;
}

/// A short specimen in coarse cells or particles: quick, and it goes the whole way.
inline impact::ImpactCase short_bar(impact::Geometry geometry) {
    impact::ImpactCase impact_case;
    impact_case.shape = specimen::make_shape(specimen::uniform_cylinder, 8e-3, 16e-3);
    impact_case.velocity_m_s = 90;
    impact_case.numerics = impact::numerics_for(geometry, "coarse");
    return impact_case;
}

}  // namespace taylorcal::testing
