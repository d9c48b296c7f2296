#include "solver/commands/run_file.hpp"

#include "common/hdf5_file.hpp"
#include "solver/commands/run_table.hpp"
#include "solver/commands/solver_provenance.hpp"

#include <nlohmann/json.hpp>

namespace taylorcal::commands {
namespace {

void write_named(Hdf5Writer& file, const std::string& dataset,
                 const std::vector<std::string>& names,
                 const std::vector<double>& values) {
    file.numbers(dataset, values);
    file.attribute("names", names, dataset);
}

void write_history(Hdf5Writer& file, const std::vector<impact::HistoryRecord>& history) {
    const std::vector<std::string> names = {"time_us",
                                            "length_mm",
                                            "foot_radius_mm",
                                            "rear_velocity_m_s",
                                            "radial_strain_rate_per_s",
                                            "largest_temperature_K",
                                            "kinetic_energy_J",
                                            "total_energy_J"};
    RowMatrix table(static_cast<Eigen::Index>(history.size()),
                    static_cast<Eigen::Index>(names.size()));
    Eigen::Index row = 0;
    for (const impact::HistoryRecord& at : history)
        table.row(row++) << at.time_us, at.length_mm, at.foot_radius_mm,
            at.rear_velocity_m_s, at.radial_strain_rate_per_s, at.largest_temperature_K,
            at.kinetic_energy_J, at.total_energy_J;
    file.matrix("history", table);
    file.attribute("names", names, "history");
}

void write_outline(Hdf5Writer& file, const observe::DeformedProfile& profile) {
    constexpr double to_mm = 1e3;
    RowMatrix table(static_cast<Eigen::Index>(profile.outline_height.size()), 2);
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
        const auto point = static_cast<std::size_t>(i);
        table.row(i) << to_mm * profile.outline_height[point],
            to_mm * profile.outline_radius[point];
    }
    file.matrix("outline", table);
    file.attribute("names", std::vector<std::string>{"height_mm", "radius_mm"},
                   "outline");
}

void write_fields(Hdf5Writer& file, const impact::Fields& fields) {
    file.numbers("fields/x_mm", fields.x_mm);
    file.numbers("fields/y_mm", fields.y_mm);
    file.numbers("fields/z_mm", fields.z_mm);
    file.numbers("fields/initial_x_mm", fields.initial_x_mm);
    file.numbers("fields/initial_y_mm", fields.initial_y_mm);
    file.numbers("fields/initial_z_mm", fields.initial_z_mm);
    file.numbers("fields/volume_mm3", fields.volume_mm3);
    file.numbers("fields/equivalent_plastic_strain", fields.equivalent_plastic_strain);
    file.numbers("fields/temperature_K", fields.temperature_K);
    file.numbers("fields/von_mises_GPa", fields.von_mises_GPa);
    file.numbers("fields/pressure_GPa", fields.pressure_GPa);
    file.numbers("fields/grain_diameter_um", fields.grain_diameter_um);
    file.numbers("fields/weakened_fraction", fields.weakened_fraction);
}

}  // namespace

void write_run_file(const std::filesystem::path& path, const impact::ImpactResult& result,
                    const nlohmann::json& description) {
    Hdf5Writer file(path);
    write_named(file, "sizes", observe::size_names(), observe::size_values(result.sizes));
    write_named(file, "descriptors", impact::descriptor_names(),
                impact::descriptor_values(result.descriptors));
    write_history(file, result.history);
    write_outline(file, result.profile);
    write_fields(file, result.fields);
    file.attribute("schema", std::string("taylorcal/run/1"));
    file.attribute("status", status_name(result.status));
    file.attribute("reason", result.reason);
    file.attribute("steps", static_cast<double>(result.steps));
    file.attribute("points", static_cast<double>(result.points));
    file.attribute("grain_updates", static_cast<double>(result.grain_updates));
    file.attribute("question", description.dump());
    file.attribute(
        "provenance",
        solver_provenance(description["seed"].get<std::uint64_t>(), description).dump());
    file.close();
}

}  // namespace taylorcal::commands
