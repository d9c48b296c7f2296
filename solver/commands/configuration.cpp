#include "solver/commands/configuration.hpp"

#include "common/errors.hpp"

namespace taylorcal::commands {
namespace {

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

}  // namespace

Configuration read_configuration(const JsonReader& reader) {
    reader.only({"geometry", "fidelity", "material"});
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
    read_material(reader.object_or_empty("material"), configuration.material);
    return configuration;
}

Configuration read_configuration(const std::string& path) {
    return read_configuration(path.empty()
                                  ? JsonReader(nlohmann::json::object(), "command line")
                                  : JsonReader::from_file(path));
}

}  // namespace taylorcal::commands
