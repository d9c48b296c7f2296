#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "solver/effects/effect_list.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace taylorcal::effects {
namespace {

void check_possible(const Effect& effect, const impact::ImpactCase& impact_case) {
    const impact::Geometry geometry = impact_case.numerics.geometry;
    const auto& possible = effect.geometries;
    if (std::find(possible.begin(), possible.end(), geometry) == possible.end()) {
        const auto& names = impact::geometry_names();
        throw InputError(fmt::format(
            "effect {} cannot be had with geometry \"{}\" (expected \"{}\"). Change the "
            "geometry, or leave the effect out.",
            effect.name, names[static_cast<std::size_t>(geometry)],
            names[static_cast<std::size_t>(possible.front())]));
    }
    const material::StrengthModel strength = impact_case.material.strength;
    require(
        !effect.needs_dislocations || strength == material::StrengthModel::dislocation,
        fmt::format("effect {} means nothing to strength \"{}\" (expected "
                    "\"dislocation\"). Change the strength, or leave the effect out.",
                    effect.name,
                    material::strength_names()[static_cast<std::size_t>(strength)]));
}

}  // namespace

std::vector<std::string> effect_names() {
    std::vector<std::string> names;
    for (const Effect& effect : effect_list()) names.push_back(effect.name);
    return names;
}

const Effect& find_effect(const std::string& name) {
    const auto& list = effect_list();
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const Effect& e) { return e.name == name; });
    if (found != list.end()) return *found;
    throw InputError(
        fmt::format("effect \"{}\" is unknown{}. \"solver effects\" lists them all.",
                    name, nearest_hint(name, effect_names())));
}

void set_amplitude(Amplitudes& amplitudes, const std::string& name, double value) {
    const Effect& effect = find_effect(name);
    require(value >= effect.lowest && value <= effect.highest,
            fmt::format("effect {} = {:.10g}{} is out of its range (expected {:g} to "
                        "{:g}). \"solver effects\" lists the ranges.",
                        name, value, effect.unit == "1" ? "" : " " + effect.unit,
                        effect.lowest, effect.highest));
    amplitudes[name] = value;
}

void apply_effects(const Amplitudes& amplitudes, impact::ImpactCase& impact_case) {
    for (const Effect& effect : effect_list()) {
        const auto found = amplitudes.find(effect.name);
        if (found == amplitudes.end() || found->second == 0) continue;
        check_possible(effect, impact_case);
        effect.apply(impact_case, found->second);
    }
}

std::string prior_name(PriorKind kind) {
    return kind == PriorKind::normal ? "normal" : "half_normal";
}

std::string acts_on_name(ActsOn acts_on) {
    switch (acts_on) {
        case ActsOn::material:
            return "material";
        case ActsOn::anvil:
            return "anvil";
        case ActsOn::initial_state:
            return "initial_state";
        case ActsOn::impact:
            break;
    }
    return "impact";
}

}  // namespace taylorcal::effects
