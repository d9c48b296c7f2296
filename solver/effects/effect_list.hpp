#pragma once

#include "solver/effects/effect.hpp"

#include <map>
#include <string>
#include <vector>

namespace taylorcal::effects {

/// Every effect, in the order in which they are applied.
const std::vector<Effect>& effect_list();
std::vector<std::string> effect_names();

/// InputError with the nearest name when unknown.
const Effect& find_effect(const std::string& name);

/// Amplitudes by name.
using Amplitudes = std::map<std::string, double>;

/// Sets one. InputError for an unknown name (with the nearest) or a value out of range.
void set_amplitude(Amplitudes& amplitudes, const std::string& name, double value);

/// Gives the case all effects whose amplitude is not zero; the others leave no trace.
/// InputError for one that the case's geometry or strength cannot have.
void apply_effects(const Amplitudes& amplitudes, impact::ImpactCase& impact_case);

/// "half_normal", "normal".
std::string prior_name(PriorKind kind);
/// "material", "anvil", "initial_state", "impact".
std::string acts_on_name(ActsOn acts_on);

}  // namespace taylorcal::effects
