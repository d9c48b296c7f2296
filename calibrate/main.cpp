#include "calibrate/commands/compare.hpp"
#include "calibrate/commands/diagnose.hpp"
#include "calibrate/commands/sample.hpp"
#include "common/errors.hpp"
#include "common/option_text.hpp"
#include "common/parse_command.hpp"
#include "common/program_code.hpp"

#include <CLI/CLI.hpp>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace calibrate = taylorcal::calibrate;

namespace {

int run(int argc, char** argv) {
    CLI::App app("Bayesian calibration of a network against measured Taylor tests.",
                 "calibrate");
    app.set_version_flag("--version", taylorcal::version_words("calibrate"));
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  calibrate sample --config calibrate.json --measurements measurements.csv "
        "--emulator emulator.json --out posterior.h5\n"
        "  calibrate compare --config calibrate.json --measurements measurements.csv "
        "--emulator emulator.json --posterior posterior.h5 --out comparison.json\n"
        "  calibrate diagnose --config calibrate.json --measurements measurements.csv "
        "--emulator emulator.json --posterior posterior.h5 --signatures signatures.h5 "
        "--finer signatures_finer.h5 --candidates candidates.json --out diagnosis.json\n"
        "  calibrate design --diagnosis diagnosis.json ... --out next_experiment.json, "
        "with the same files as diagnose");

    calibrate::InputPaths inputs;
    calibrate::DiagnosisPaths paths;
    std::string out, posterior, diagnosis;
    int threads = 0;
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
    const auto add_threads = [&](CLI::App* command) {
        command
            ->add_option("--threads", threads,
                         "Threads (0, the default: one a processor); the result does "
                         "not depend on them")
            ->check(taylorcal::threads_problem);
    };
    CLI::App* sample = app.add_subcommand(
        "sample", "Draw parameters, weigh them by the likelihood, and map the posterior");
    add_files(sample, "Posterior to write (HDF5)");
    add_threads(sample);
    CLI::App* compare = app.add_subcommand(
        "compare", "Compare the calibrated model with every shot: where does it fail?");
    add_files(compare, "Comparison to write (JSON)");
    compare->add_option("--posterior", posterior, "Posterior of the same inputs (HDF5)")
        ->required();
    const auto add_signatures = [&](CLI::App* command) {
        command
            ->add_option("--posterior", paths.posterior, "Posterior of the same inputs")
            ->required();
        command
            ->add_option("--signatures", paths.signatures,
                         "Solver runs with and without each candidate (HDF5)")
            ->required();
        command->add_option("--finer", paths.finer,
                            "The runs without candidates at a finer fidelity (HDF5)");
        command
            ->add_option("--candidates", paths.candidates,
                         "Effects and constants that may explain a misfit (JSON)")
            ->required();
        add_threads(command);
    };
    CLI::App* diagnose = app.add_subcommand(
        "diagnose", "Which missing effect would explain what the model gets wrong?");
    add_files(diagnose, "Diagnosis to write (JSON)");
    add_signatures(diagnose);
    CLI::App* design = app.add_subcommand(
        "design", "Which shots would tell the explanations of a diagnosis apart?");
    add_files(design, "Next experiments to write (JSON)");
    design->add_option("--diagnosis", diagnosis, "Diagnosis of the same inputs (JSON)")
        ->required();
    add_signatures(design);

    if (const auto status = taylorcal::parse_command(app, argc, argv)) return *status;
    if (threads == 0) threads = omp_get_max_threads();
    if (sample->parsed()) calibrate::sample(inputs, out, threads);
    if (compare->parsed()) calibrate::compare(inputs, posterior, out);
    if (diagnose->parsed()) calibrate::diagnose(inputs, paths, out, threads);
    if (design->parsed()) calibrate::design(inputs, paths, diagnosis, out, threads);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("calibrate"));
    spdlog::set_pattern("%n: %^%l%$: %v");
    return taylorcal::guarded_main("calibrate", [=] { return run(argc, argv); });
}
