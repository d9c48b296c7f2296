#include "solver/commands/configuration.hpp"

#include "common/errors.hpp"

namespace taylorcal::commands {
namespace {

/// Overrides what the fidelity chose, for studies of convergence and dissipation.
void read_numerics(const JsonReader& reader, impact::Numerics& numerics) {
    reader.only({"elements_across_radius", "grains_per_point", "cfl", "linear_viscosity",
                 "quadratic_viscosity", "hourglass"});
    const auto whole = [&](const char* key, int most, int chosen) {
        const long long value = reader.integer(key, chosen);
        if (value < 1 || value > most)
            reader.fail(key, "= " + std::to_string(value) + " (expected 1 to " +
                                 std::to_string(most) + ").");
        return static_cast<int>(value);
    };
    const auto share = [&](const char* key, double most, double chosen) {
        return reader.number_in(key, 0, most, chosen);
    };
    numerics.elements_across_radius =
        whole("elements_across_radius", 200, numerics.elements_across_radius);
    numerics.grains_per_point = whole("grains_per_point", 256, numerics.grains_per_point);
    numerics.cfl = reader.number_in("cfl", 1e-3, 1, numerics.cfl);
    numerics.linear_viscosity = share("linear_viscosity", 10, numerics.linear_viscosity);
    numerics.quadratic_viscosity =
        share("quadratic_viscosity", 10, numerics.quadratic_viscosity);
    numerics.hourglass = share("hourglass", 10, numerics.hourglass);
}

void read_effects(const JsonReader& reader, effects::Amplitudes& amplitudes) {
    reader.only(effects::effect_names());
    for (const std::string& name : reader.keys()) {
        const double value = reader.number(name);
        try {
            effects::set_amplitude(amplitudes, name, value);
        } catch (const InputError& error) {
            throw InputError(reader.where() + ": " + error.what());
        }
    }
}

}  // namespace

void read_material(const JsonReader& reader, material::Parameters& material) {
    reader.only(material::setting_names());
    for (const std::string& name : reader.keys()) {
        const bool is_model = name == "strength" || name == "equation_of_state";
        try {
            if (is_model)
                material::set_model(material, name, reader.text(name));
            else
                material::set_parameter(material, name, reader.number(name));
        } catch (const InputError& error) {
            const std::string message = error.what();
            // The reader's own messages name the file already.
            throw InputError(message.starts_with(reader.where())
                                 ? message
                                 : reader.where() + ": material: " + message);
        }
    }
}

void check_strength(const JsonReader& reader, const material::Parameters& material) {
    try {
        material::check_strength(material);
    } catch (const InputError& error) {
        throw InputError(reader.where() + ": " + error.what());
    }
}

Configuration read_configuration(const JsonReader& reader) {
    reader.only({"geometry", "fidelity", "numerics", "material", "effects"});
    const std::string geometry =
        reader.word("geometry", impact::geometry_names(), "axisymmetric");
    const std::string fidelity =
        reader.word("fidelity", impact::fidelity_names(), "standard");
    Configuration configuration;
    configuration.document = reader.json();
    configuration.document["geometry"] = geometry;
    configuration.document["fidelity"] = fidelity;
    configuration.numerics =
        impact::numerics_for(impact::geometry_from_name(geometry), fidelity);
    read_numerics(reader.object_or_empty("numerics"), configuration.numerics);
    read_material(reader.object_or_empty("material"), configuration.material);
    read_effects(reader.object_or_empty("effects"), configuration.effects);
    return configuration;
}

Configuration read_configuration(const std::string& path) {
    return read_configuration(path.empty()
                                  ? JsonReader(nlohmann::json::object(), "command line")
                                  : JsonReader::from_file(path));
}

}  // namespace taylorcal::commands
