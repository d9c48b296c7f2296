#include "solver/commands/plate.hpp"

#include "common/atomic_file.hpp"
#include "solver/commands/configuration.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace taylorcal::commands {

namespace {

constexpr const char* plate_help = R"(PLATE is a JSON file:
  flyer_thickness_mm, target_thickness_mm
  velocity_m_s            of the flyer
  duration_us             from the impact on
  cell_um                 optional, largest height of a cell (5)
  initial_temperature_K   optional (300)
  seed                    optional, of the grain orientations (1)
  material                optional, {name: value} as "solver parameters" lists them
Both plates are of one metal, lateral motion is blocked, and nothing breaks: where tension
exceeds the metal's strength a real plate spalls and the model does not.

Example: solver plate tests/verification/plates/copper_308_m_s.json --out velocity.csv)";

constexpr double mm = 1e-3, um = 1e-6, us = 1e-6;
constexpr double most_cell_steps = 1e10;  // an hour

}  // namespace

plate::PlateCase read_plate_case(const JsonReader& reader) {
    reader.only({"flyer_thickness_mm", "target_thickness_mm", "velocity_m_s",
                 "duration_us", "cell_um", "initial_temperature_K", "seed", "material"});
    plate::PlateCase plate_case;
    plate_case.flyer_thickness = mm * reader.number_in("flyer_thickness_mm", 1e-3, 1e3);
    plate_case.target_thickness = mm * reader.number_in("target_thickness_mm", 1e-3, 1e3);
    plate_case.velocity = reader.number_in("velocity_m_s", 1e-3, 5000);
    plate_case.duration = us * reader.number_in("duration_us", 1e-6, 1e4);
    plate_case.cell = um * reader.number_in("cell_um", 1e-3, 1e4, 5);
    plate_case.initial_temperature_K =
        reader.number_in("initial_temperature_K", 50, 1300, 300);
    const long long seed = reader.integer("seed", 1);
    if (seed < 0) reader.fail("seed", fmt::format("= {} (expected 0 or more).", seed));
    plate_case.seed = static_cast<std::uint64_t>(seed);
    read_material(reader.object_or_empty("material"), plate_case.material);
    check_strength(reader, plate_case.material);
    const double cells =
        (plate_case.flyer_thickness + plate_case.target_thickness) / plate_case.cell;
    const double steps = plate_case.duration / (plate_case.cell / 1e4);
    if (cells * steps > most_cell_steps)
        reader.fail("cell_um", fmt::format("= {} makes {:.2g} cells and about {:.2g} "
                                           "steps. Choose larger cells.",
                                           plate_case.cell / um, cells, steps));
    return plate_case;
}

std::string to_csv(const plate::PlateResult& result) {
    std::string csv = "time_us,free_surface_velocity_m_s,interface_velocity_m_s\n";
    for (const plate::PlateRecord& record : result.history)
        csv += fmt::format("{:.6f},{:.4f},{:.4f}\n", record.time / us,
                           record.free_surface_velocity, record.interface_velocity);
    return csv;
}

void add_plate(CLI::App& app) {
    struct Options {
        std::string plate;
        std::string out;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("plate", "Flyer plate: free-surface velocity");
    command->add_option("plate", options->plate, "JSON file of the experiment")
        ->type_name("PLATE.json")
        ->required();
    command->add_option("--out", options->out, "table to write")
        ->type_name("velocity.csv")
        ->required();
    command->footer(plate_help);
    command->callback([options] {
        require_writable(options->out, {options->plate});
        const plate::PlateResult result =
            plate::simulate_plate(read_plate_case(JsonReader::from_file(options->plate)));
        write_text_atomically(options->out, to_csv(result));
        fmt::print(
            "steps                       {}\n"
            "largest_stress_GPa          {:.4g}\n"
            "largest_tension_GPa         {:.4g}   (no spall in the model)\n"
            "largest_temperature_K       {:.4g}\n"
            "energy_error                {:.3g}\n",
            result.steps, result.largest_stress / 1e9, result.largest_tension / 1e9,
            result.largest_temperature_K, result.energy_error);
    });
}

}  // namespace taylorcal::commands
