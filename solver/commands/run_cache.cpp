#include "solver/commands/run_cache.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/program_code.hpp"
#include "common/sha256.hpp"
#include "common/simd.hpp"

#include <fstream>
#include <random>
#include <system_error>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

namespace taylorcal::commands {
namespace {

namespace fs = std::filesystem;

/// The material's constants that are not at their default.
nlohmann::json changed_constants(const material::Parameters& parameters) {
    const material::Parameters defaults;
    nlohmann::json changed = nlohmann::json::object();
    for (const material::ParameterInfo& info : material::parameter_list())
        if (parameters.*info.member != defaults.*info.member)
            changed[info.name] = parameters.*info.member;
    changed["strength"] = static_cast<int>(parameters.strength);
    changed["equation_of_state"] = static_cast<int>(parameters.equation_of_state);
    return changed;
}

/// `folder` with its parents' permissions, so that all who share the cache may write
/// there.
void make_folder(const fs::path& folder) {
    if (fs::exists(folder)) return;
    fs::create_directories(folder);
    std::error_code ignored;
    fs::permissions(folder, fs::status(folder.parent_path()).permissions(), ignored);
}

/// Under a name that nobody else draws first: several hosts may keep the same run at
/// once, and share numbers of processes.
void write_entry(const fs::path& path, const std::string& text) {
    make_folder(path.parent_path());
    std::random_device random;
    const fs::path own =
        fmt::format("{}.{:08x}{:08x}.tmp", path.string(), random(), random());
    std::ofstream file(own, std::ios::binary);
    file << text << std::flush;
    const bool good = file.good();
    file.close();
    std::error_code problem;
    if (good) fs::rename(own, path, problem);
    if (good && !problem) return;
    std::error_code ignored;
    fs::remove(own, ignored);
    throw std::runtime_error(fmt::format("{} cannot be written", path.string()));
}

}  // namespace

std::string run_question(const Design& design, std::size_t row,
                         const Configuration& configuration) {
    Configuration of_run = configuration;
    nlohmann::json shot = nlohmann::json::object();
    for (std::size_t column = 0; column < design.input_names.size(); ++column) {
        const std::string& name = design.input_names[column];
        const double value = design.inputs(static_cast<Eigen::Index>(row),
                                           static_cast<Eigen::Index>(column));
        if (!set_input(of_run, name, value)) shot[name] = value;
    }
    nlohmann::json amplitudes = nlohmann::json::object();
    for (const auto& [name, amplitude] : of_run.effects)
        if (amplitude != 0) amplitudes[name] = amplitude;
    const nlohmann::json question = {
        {"schema", "taylorcal/cached_run/1"},
        {"solver_code", program_code()},
        {"simd", simd::name(simd::variant())},
        {"geometry", configuration.document.at("geometry")},
        {"fidelity", configuration.document.at("fidelity")},
        {"numerics", configuration.document.value("numerics", nlohmann::json::object())},
        {"material", changed_constants(of_run.material)},
        {"effects", amplitudes},
        {"shape", design.shape[row]},
        {"shot", shot},
        {"seed", design.seed[row]}};
    return question.dump();
}

RunCache::RunCache(fs::path folder, const Design& design,
                   const Configuration& configuration)
    : folder_(std::move(folder)) {
    if (folder_.empty()) return;
    std::error_code problem;
    fs::create_directories(folder_, problem);
    require(fs::is_directory(folder_),
            fmt::format("{}: no folder for the cache of runs ({}). Choose another place, "
                        "or none.",
                        folder_.string(), problem.message()));
    run_ids_ = design.run_id;
    for (std::size_t row = 0; row < design.rows(); ++row)
        questions_.push_back(run_question(design, row, configuration));
}

fs::path RunCache::place(const std::string& question) const {
    const std::string digest = sha256(question);
    return folder_ / digest.substr(0, 2) / (digest + ".json");
}

std::optional<FinishedRun> RunCache::found(std::size_t row) const {
    if (questions_.empty()) return std::nullopt;
    const std::string& question = questions_[row];
    std::ifstream file(place(question), std::ios::binary);
    if (!file) return std::nullopt;
    try {
        const auto entry = nlohmann::json::parse(file);
        const auto& run = entry.at("run");
        if (entry.at("question") != question || entry.at("sha256") != sha256(run.dump()))
            return std::nullopt;
        FinishedRun cached = run_from_json(run);
        cached.run_id = run_ids_[row];
        return cached;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

void RunCache::keep(std::size_t row, const FinishedRun& run) {
    using impact::Status;
    if (questions_.empty() || run.status == Status::failed ||
        run.status == Status::over_cpu_limit)
        return;
    FinishedRun unnumbered = run;
    unnumbered.run_id = 0;
    const nlohmann::json answer = to_json(unnumbered);
    const nlohmann::json entry = {{"question", questions_[row]},
                                  {"run", answer},
                                  {"sha256", sha256(answer.dump())}};
    try {
        write_entry(place(questions_[row]), entry.dump() + "\n");
    } catch (const std::exception& error) {
        if (!warned_) spdlog::warn("the cache of runs is not added to: {}", error.what());
        warned_ = true;
    }
}

}  // namespace taylorcal::commands
