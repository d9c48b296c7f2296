#include "common/errors.hpp"
#include "common/option_text.hpp"
#include "common/parse_command.hpp"
#include "common/program_code.hpp"
#include "emulator/commands/commands.hpp"

#include <CLI/CLI.hpp>
#include <omp.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace emulator = taylorcal::emulator;

namespace {

int run(int argc, char** argv) {
    CLI::App app("Regression networks: learn a database of runs, then answer at once.",
                 "emulator");
    app.set_version_flag("--version", taylorcal::version_words("emulator"));
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  emulator train database.h5 --config train.json --out emulator.json\n"
        "  emulator train coarse.h5 --better fine.h5 --config train.json --out "
        "emulator.json\n"
        "  emulator train wider.h5 --config wider.json --from emulator.json --out "
        "wider_emulator.json\n"
        "  emulator validate emulator.json database.h5\n"
        "  emulator predict emulator.json points.csv\n"
        "  emulator predict emulator.json --set velocity_m_s=190 --category "
        "uniform_cylinder");

    emulator::TrainArguments training;
    training.threads = 0;
    CLI::App* train = app.add_subcommand("train", "Train an ensemble on a database");
    train->add_option("database", training.database, "Database of runs (HDF5)")
        ->required();
    train->add_option("--config", training.config, "What to learn, and how (JSON)")
        ->required();
    train->add_option("--out", training.out, "Emulator file to write (JSON)")->required();
    train->add_option("--better", training.better,
                      "Runs of a better solver (HDF5): the network answers as that one, "
                      "and learns from the others as far as they agree");
    train->add_option("--from", training.from,
                      "Emulator of fewer inputs to go on from (JSON); layers and neurons "
                      "stay its own");
    train
        ->add_option("--threads", training.threads,
                     "Members trained at once (0, the default: one a processor)")
        ->check(taylorcal::threads_problem);

    std::string model, database;
    CLI::App* validate = app.add_subcommand(
        "validate",
        "Errors against all finished runs of a database, by output and shape (CSV)");
    validate->add_option("emulator", model, "Emulator file")->required();
    validate->add_option("database", database, "Database of runs (HDF5)")->required();

    emulator::PredictArguments prediction;
    CLI::App* predict = app.add_subcommand("predict", "Outputs at given points (CSV)");
    predict->add_option("emulator", prediction.emulator, "Emulator file")->required();
    predict->add_option("inputs", prediction.table, "Table of points (CSV)");
    predict->add_option("--set", prediction.set, "One point: name=value, repeated");
    predict->add_option("--category", prediction.category, "The point's category value");

    if (const auto status = taylorcal::parse_command(app, argc, argv)) return *status;
    if (training.threads == 0) training.threads = omp_get_max_threads();
    if (train->parsed()) return emulator::train(training);
    if (validate->parsed()) return emulator::validate(model, database);
    return emulator::predict(prediction);
}

}  // namespace

int main(int argc, char** argv) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("emulator"));
    spdlog::set_pattern("%n: %v");
    return taylorcal::guarded_main("emulator", [=] { return run(argc, argv); });
}
