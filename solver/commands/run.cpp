#include "solver/commands/run.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/option_text.hpp"
#include "solver/commands/run_file.hpp"
#include "solver/commands/run_table.hpp"
#include "solver/commands/shot.hpp"
#include "solver/commands/vtk_series.hpp"
#include "solver/impact/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

namespace taylorcal::commands {
namespace {

struct RunOptions {
    std::string configuration;
    std::string geometry;
    std::string fidelity;
    std::vector<std::string> settings;
    std::vector<std::string> numerics;
    Shot shot;
    double until_us = 0;
    std::string out;
    std::string snapshots;
    double snapshot_interval_us = 5;
    bool json = false;
};

/// JSON and HDF5 keep seeds with a sign.
constexpr std::uint64_t most_seed = std::numeric_limits<std::int64_t>::max();

const char* const samples = R"(Sample runs:
  solver run --shape truncated_cone --velocity 120
  solver run solver.json --shape reduced_head_3mm --velocity 90 --out run.h5
  solver run --velocity 117.6 --geometry 3d --set hardening_coefficient=2.8
  solver run --shape truncated_cone --velocity 120 --set anvil_friction=0.05
  solver run --shape reduced_head_3mm --velocity 90 --snapshots fields --every-us 10
  solver run --shape truncated_cone_3mm_by_9mm_of_7.6mm_by_25.4mm --velocity 150 \
    --diameter-mm 7.6 --length-mm 25.4
  solver run --velocity 227 --diameter-mm 6.4 --length-mm 32.4 --until-us 80 \
    --set strength=j2 --set equation_of_state=linear --set bulk_modulus=130e9 \
    --set poisson_ratio=0.35)";

/// Puts "name=value" into a block of the configuration, a number where it reads as one.
void apply_setting(const std::string& option, const std::string& setting,
                   nlohmann::json& block) {
    const std::size_t equals = setting.find('=');
    require(equals != std::string::npos && equals > 0 && equals + 1 < setting.size(),
            fmt::format("{} {} (expected name=value, as in --set "
                        "hardening_coefficient=2.8).",
                        option, setting));
    const std::string value = setting.substr(equals + 1);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    auto& entry = block[setting.substr(0, equals)];
    if (*end == '\0' && number == std::floor(number) && std::abs(number) < 1e9)
        entry = static_cast<long long>(number);
    else if (*end == '\0')
        entry = number;
    else
        entry = value;
}

/// The block that "name=value" belongs to. InputError with the nearest name when no
/// parameter and no effect has this one.
std::string block_of(const std::string& setting) {
    const std::string name = setting.substr(0, setting.find('='));
    const std::vector<std::string> effect_names = effects::effect_names();
    if (std::find(effect_names.begin(), effect_names.end(), name) != effect_names.end())
        return "effects";
    std::vector<std::string> known = material::setting_names();
    if (std::find(known.begin(), known.end(), name) != known.end()) return "material";
    known.insert(known.end(), effect_names.begin(), effect_names.end());
    throw InputError(fmt::format(
        "--set {}: \"{}\" is unknown{}. \"solver parameters\" and \"solver effects\" "
        "list "
        "the names.",
        setting, name, nearest_hint(name, known)));
}

Configuration configuration_of(const RunOptions& options) {
    const JsonReader file = options.configuration.empty()
                                ? JsonReader(nlohmann::json::object(), "solver.json")
                                : JsonReader::from_file(options.configuration);
    read_configuration(file);  // Errors of the file are told as such.
    nlohmann::json document = file.json();
    if (!options.geometry.empty()) document["geometry"] = options.geometry;
    if (!options.fidelity.empty()) document["fidelity"] = options.fidelity;
    for (const std::string& setting : options.settings)
        apply_setting("--set", setting, document[block_of(setting)]);
    for (const std::string& setting : options.numerics)
        apply_setting("--numerics", setting, document["numerics"]);
    return read_configuration(JsonReader(document, "command line"));
}

/// Most memory that this process has held so far [B]; 0 where Linux does not tell.
/// (getrusage would count what the parent held when it started this process.)
std::int64_t peak_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::int64_t kilobytes = 0;
        if (word == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
    }
    return 0;
}

void run(const RunOptions& options) {
    if (!options.out.empty()) require_writable(options.out, {options.configuration});
    const Configuration configuration = configuration_of(options);
    impact::ImpactCase impact_case =
        make_case(options.shot, configuration, "command line");
    require(options.until_us >= 0 && options.until_us <= 1e4,
            fmt::format("--until-us {} (expected 0 to 10000).", options.until_us));
    impact_case.run_until_s = 1e-6 * options.until_us;

    require(options.snapshot_interval_us >= 0.01,
            fmt::format("--every-us {} (expected 0.01 or more).",
                        options.snapshot_interval_us));
    if (!options.snapshots.empty())
        impact_case.snapshot_interval_s = 1e-6 * options.snapshot_interval_us;

    const std::int64_t memory_before = peak_memory();
    const impact::ImpactResult result = impact::simulate(impact_case);
    const std::int64_t memory = peak_memory() - memory_before;

    const nlohmann::json description =
        describe(options.shot, configuration, options.until_us);
    if (!options.out.empty()) write_run_file(options.out, result, description);
    if (!options.snapshots.empty()) write_vtk_series(options.snapshots, result.snapshots);
    nlohmann::json answer = run_json(result, description);
    answer["memory_B"] = memory;
    fmt::print("{}",
               options.json ? answer.dump(2) + "\n" : run_table(result, description));
    if (result.status == impact::Status::failed)
        throw NumericalError("the run failed: " + result.reason);
    if (result.status != impact::Status::stopped)
        spdlog::warn("the run was cut short: {}", result.reason);
}

}  // namespace

void add_run(CLI::App& app) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = app.add_subcommand("run", "Compute one impact");
    command->add_option("configuration", options->configuration,
                        "solver.json: geometry, fidelity, material; all optional");
    command
        ->add_option("--shape", options->shot.shape,
                     "uniform_cylinder, reduced_head_4mm, reduced_head_3mm, "
                     "truncated_cone, or measures of your own as in "
                     "reduced_head_5mm_by_12mm")
        ->capture_default_str();
    command
        ->add_option("--velocity,--velocity-m-s", options->shot.velocity_m_s,
                     "impact velocity [m/s]")
        ->required();
    command
        ->add_option("--diameter-mm", options->shot.initial_diameter_mm,
                     "initial diameter of the rear [mm]")
        ->capture_default_str();
    command
        ->add_option("--length-mm", options->shot.initial_length_mm,
                     "initial length [mm]")
        ->capture_default_str();
    command
        ->add_option("--temperature-K", options->shot.initial_temperature_K,
                     "initial temperature [K]")
        ->capture_default_str();
    command
        ->add_option("--geometry", options->geometry,
                     "axisymmetric or 3d (over solver.json's)")
        ->check(empty_problem);
    command
        ->add_option("--fidelity", options->fidelity,
                     "coarse, standard or fine (over solver.json's)")
        ->check(empty_problem);
    command
        ->add_option("--set", options->settings,
                     "name=value of a material parameter or an effect, see `solver "
                     "parameters` and "
                     "`solver effects`; may be repeated")
        ->allow_extra_args(false);
    command
        ->add_option("--numerics", options->numerics,
                     "name=value over the fidelity's own: elements_across_radius, "
                     "grains_per_point, cfl, linear_viscosity, quadratic_viscosity, "
                     "hourglass; may be repeated")
        ->allow_extra_args(false);
    command->add_option("--seed", options->shot.seed, "of the grain orientations")
        ->check([](const std::string& text) { return count_problem(text, most_seed); })
        ->capture_default_str();
    command->add_option("--until-us", options->until_us,
                        "stop at this time [us] instead of with the rear");
    command
        ->add_option("--out", options->out,
                     "HDF5 file of sizes, history, outline and fields")
        ->check(empty_problem);
    command
        ->add_option("--snapshots", options->snapshots,
                     "folder for the fields on the way, as ParaView opens them")
        ->check(empty_problem);
    command
        ->add_option("--every-us", options->snapshot_interval_us,
                     "time between snapshots [us]")
        ->capture_default_str();
    command->add_flag("--json", options->json, "print JSON instead of tables");
    command->footer(samples);
    command->callback([options] { run(*options); });
}

}  // namespace taylorcal::commands
