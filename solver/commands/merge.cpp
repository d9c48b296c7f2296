#include "solver/commands/merge.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal::commands {
namespace {

/// Adds the rows of `part` to `whole`.
void append(Database& whole, const Database& part) {
    Design& design = whole.design;
    const Eigen::Index rows = design.inputs.rows();
    design.inputs.conservativeResize(rows + part.design.inputs.rows(), Eigen::NoChange);
    design.inputs.bottomRows(part.design.inputs.rows()) = part.design.inputs;
    const auto extend = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    extend(design.run_id, part.design.run_id);
    extend(design.seed, part.design.seed);
    extend(design.shape, part.design.shape);
    extend(whole.runs, part.runs);
}

/// Adds the inputs that `design` lacks as columns of zeros.
void add_zero_inputs(Design& design, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (std::ranges::find(design.input_names, name) != design.input_names.end())
            continue;
        design.input_names.push_back(name);
        design.inputs.conservativeResize(Eigen::NoChange, design.inputs.cols() + 1);
        design.inputs.rightCols(1).setZero();
    }
}

/// The chunks' common provenance, or all that occur when they were computed differently.
nlohmann::json joined(const std::vector<nlohmann::json>& records) {
    nlohmann::json distinct = nlohmann::json::array();
    for (const auto& record : records)
        if (std::find(distinct.begin(), distinct.end(), record) == distinct.end())
            distinct.push_back(record);
    if (distinct.size() == 1) return distinct.front();
    return {{"program", "solver"}, {"chunks", distinct}};
}

}  // namespace

Database merge(const std::vector<std::string>& paths,
               const std::vector<std::string>& zero_inputs) {
    for (const std::string& name : zero_inputs) require_known_input(name, "--zero-input");
    Database whole;
    std::map<std::int64_t, std::string> owner;
    std::vector<nlohmann::json> records;
    for (const std::string& path : paths) {
        Database part = read_database(path);
        add_zero_inputs(part.design, zero_inputs);
        if (records.empty()) {
            whole.configuration = part.configuration;
            whole.design.input_names = part.design.input_names;
            whole.design.inputs.resize(0, part.design.inputs.cols());
        }
        require(part.configuration == whole.configuration,
                fmt::format("{}: computed with another configuration than {}. Compute "
                            "both with one solver.json.",
                            path, paths.front()));
        require(part.design.input_names == whole.design.input_names,
                fmt::format("{}: has other inputs than {}. Merge chunks of one design.",
                            path, paths.front()));
        for (const std::int64_t id : part.design.run_id) {
            const auto [first, is_new] = owner.emplace(id, path);
            require(is_new,
                    fmt::format("{}: run {} is in {} as well. Give each chunk its "
                                "own rows.",
                                path, id, first->second));
        }
        records.push_back(part.provenance);
        append(whole, part);
    }
    whole.provenance = joined(records);
    return whole;
}

void add_merge(CLI::App& app) {
    struct Options {
        std::vector<std::string> chunks;
        std::vector<std::string> zero_inputs;
        std::string out;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("merge", "Join chunks of a database");
    command->add_option("chunks", options->chunks, "databases to join")->required();
    command->add_option("--out", options->out, "database to write (HDF5)")->required();
    command->add_option("--zero-input", options->zero_inputs,
                        "an input that is 0 in the databases without it; repeated");
    command->footer(
        "Sample runs:\n"
        "  solver merge chunk_0.h5 chunk_1.h5 --out database.h5\n"
        "  solver merge old.h5 chunk_0.h5 --zero-input anvil_friction --out new.h5");
    command->callback([options] {
        require_writable(options->out);
        write_database(options->out, merge(options->chunks, options->zero_inputs));
    });
}

}  // namespace taylorcal::commands
