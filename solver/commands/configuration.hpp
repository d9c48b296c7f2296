#pragma once

#include "common/json_reader.hpp"
#include "solver/effects/effect_list.hpp"
#include "solver/impact/impact_case.hpp"

#include <string>

#include <nlohmann/json.hpp>

namespace taylorcal::commands {

/// What solver.json says: how impacts are computed, and material and effects before a
/// run's own are set.
struct Configuration {
    nlohmann::json document;  ///< as given, with geometry and fidelity filled in
    impact::Numerics numerics;
    material::Parameters material;
    effects::Amplitudes effects;
};

/// Sets the parameters that an object {name: value} gives. InputError as below.
void read_material(const JsonReader& reader, material::Parameters& material);

/// `material::check_strength`, with the reader's file in its message.
void check_strength(const JsonReader& reader, const material::Parameters& material);

/// Reads {"geometry", "fidelity", "numerics": {name: value}, "material": {name: value},
/// "effects": {name: amplitude}}; all keys are optional.
/// InputError for an unknown key, a wrong word or a value out of range.
Configuration read_configuration(const JsonReader& reader);

/// The same from a file, or all defaults when `path` is empty.
Configuration read_configuration(const std::string& path);

}  // namespace taylorcal::commands
