#include "solver/commands/point.hpp"

#include "common/atomic_file.hpp"
#include "solver/commands/deformation_path.hpp"
#include "solver/commands/material_point.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

namespace taylorcal::commands {

namespace {

constexpr const char* path_help = R"(PATH is a JSON file:
  equation_of_state            "copper", "copper_md" (a network trained on molecular
                               dynamics) or "linear" (constant modulus, for verification)
  orientation_quaternion_wxyz  rotation from the crystal frame to the lab frame
  time_step_s                  largest step
  segments                     list of {"velocity_gradient_per_s": 3 x 3 with
                               L_ij = dv_i/dx_j, "duration_s": ..., "outputs": n}
  parameters                   optional, {name: value} as "solver parameters" lists them
  strength                     optional, "dislocation" (default), "j2", "johnson_cook",
                               "elastic"
The table has a row at duration_s x k/n of each segment, k = 1 to n; stress in the lab frame.

Example: solver point tests/verification/paths/compression.json --out curve.csv)";

}  // namespace

void add_point(CLI::App& app) {
    struct Options {
        std::string path;
        std::string out;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("point", "Follow one grain along a path of deformation");
    command->add_option("path", options->path, "JSON file of the path")
        ->type_name("PATH.json")
        ->required();
    command->add_option("--out", options->out, "table to write")
        ->type_name("curve.csv")
        ->required();
    command->footer(path_help);
    command->callback([options] {
        require_writable(options->out, {options->path});
        const auto path = read_deformation_path(JsonReader::from_file(options->path));
        const auto records = follow(path);
        write_text_atomically(options->out, to_csv(records));
        spdlog::info("{}: {} rows", options->out, records.size());
    });
}

}  // namespace taylorcal::commands
