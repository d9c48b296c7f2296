#include "common/errors.hpp"
#include "common/parse_command.hpp"
#include "common/program_code.hpp"
#include "solver/commands/batch.hpp"
#include "solver/commands/effects.hpp"
#include "solver/commands/merge.hpp"
#include "solver/commands/parameters.hpp"
#include "solver/commands/plate.hpp"
#include "solver/commands/point.hpp"
#include "solver/commands/run.hpp"

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace {

int run(int argc, char** argv) {
    using namespace taylorcal::commands;
    CLI::App app{"Taylor impact of copper with a dislocation model of plasticity.",
                 "solver"};
    app.set_version_flag("--version", taylorcal::version_words("solver"));
    app.require_subcommand(1);
    app.footer("\"solver COMMAND --help\" ends with sample runs.");
    add_run(app);
    add_batch(app);
    add_merge(app);
    add_point(app);
    add_plate(app);
    add_parameters(app);
    add_effects(app);
    return taylorcal::parse_command(app, argc, argv).value_or(0);
}

}  // namespace

int main(int argc, char** argv) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("solver"));
    spdlog::set_pattern("solver: %^%l%$: %v");
    return taylorcal::guarded_main("solver", [=] { return run(argc, argv); });
}
