#include "calibrate/commands/compare.hpp"
#include "calibrate/commands/sample.hpp"
#include "common/errors.hpp"
#include "common/provenance.hpp"

#include <CLI/CLI.hpp>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace calibrate = taylorcal::calibrate;

int main(int argc, char** argv) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("calibrate"));
    spdlog::set_pattern("%n: %^%l%$: %v");

    CLI::App app("Bayesian calibration of a network against measured Taylor tests.",
                 "calibrate");
    app.set_version_flag("--version", "calibrate " + taylorcal::version());
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  calibrate sample --config calibrate.json --measurements measurements.csv "
        "--emulator emulator.json --out posterior.h5\n"
        "  calibrate compare --config calibrate.json --measurements measurements.csv "
        "--emulator emulator.json --posterior posterior.h5 --out comparison.json");

    calibrate::InputPaths inputs;
    std::string out, posterior;
    int threads = omp_get_max_threads();
    const auto add_files = [&](CLI::App* command, const std::string& what) {
        command
            ->add_option("--config", inputs.settings, "What to calibrate, and how (JSON)")
            ->required();
        command->add_option("--measurements", inputs.measurements, "Measured shots (CSV)")
            ->required();
        command->add_option("--emulator", inputs.emulator, "Trained network (JSON)")
            ->required();
        command->add_option("--out", out, what)->required();
    };
    CLI::App* sample = app.add_subcommand(
        "sample", "Draw parameters, weigh them by the likelihood, and map the posterior");
    add_files(sample, "Posterior to write (HDF5)");
    sample
        ->add_option("--threads", threads, "Threads; the result does not depend on them")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    CLI::App* compare = app.add_subcommand(
        "compare", "Compare the calibrated model with every shot: where does it fail?");
    add_files(compare, "Comparison to write (JSON)");
    compare->add_option("--posterior", posterior, "Posterior of the same inputs (HDF5)")
        ->required();

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 1;
    }
    return taylorcal::guarded_main("calibrate", [&] {
        if (sample->parsed()) calibrate::sample(inputs, out, threads);
        if (compare->parsed()) calibrate::compare(inputs, posterior, out);
        return 0;
    });
}
