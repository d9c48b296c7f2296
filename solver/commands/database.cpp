#include "solver/commands/database.hpp"

#include "common/atomic_file.hpp"
#include "common/csv_table.hpp"
#include "common/errors.hpp"
#include "solver/observe/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal::commands {
namespace {

std::filesystem::path cost_path(const std::filesystem::path& path) {
    return path.string() + ".cost.csv";
}

RowMatrix table(const std::vector<FinishedRun>& runs,
                std::vector<double> FinishedRun::*member, std::size_t columns) {
    RowMatrix values(static_cast<Eigen::Index>(runs.size()),
                     static_cast<Eigen::Index>(columns));
    for (Eigen::Index row = 0; row < values.rows(); ++row)
        for (Eigen::Index column = 0; column < values.cols(); ++column)
            values(row, column) = (runs[static_cast<std::size_t>(row)].*
                                   member)[static_cast<std::size_t>(column)];
    return values;
}

std::vector<double> row_values(const RowMatrix& values, std::size_t row) {
    const auto at = values.row(static_cast<Eigen::Index>(row));
    return {at.begin(), at.end()};
}

/// The outlines, where any run has one; rows without are NaN.
void write_outlines(Hdf5Writer& file, std::vector<FinishedRun> runs) {
    const auto has_outline = [](const FinishedRun& run) {
        return !run.outline_radius.empty();
    };
    if (std::none_of(runs.begin(), runs.end(), has_outline)) return;
    for (FinishedRun& run : runs)
        run.outline_radius.resize(observe::outline_points,
                                  std::numeric_limits<double>::quiet_NaN());
    const auto& fractions = observe::outline_fractions();
    file.matrix("outline_radius",
                table(runs, &FinishedRun::outline_radius, observe::outline_points));
    file.attribute("fractions", std::vector<double>(fractions.begin(), fractions.end()),
                   "outline_radius");
}

/// One row a run, or no row at all in a database made before outlines were kept.
RowMatrix read_outlines(const Hdf5Reader& file, const std::filesystem::path& path,
                        Eigen::Index rows) {
    if (!file.has("outline_radius")) return {};
    RowMatrix outlines = file.matrix("outline_radius");
    require(outlines.rows() == rows &&
                outlines.cols() == static_cast<Eigen::Index>(observe::outline_points),
            path.string() +
                ": \"outline_radius\" has another size than this version "
                "writes. Make the file again.");
    return outlines;
}

void write_costs(const std::filesystem::path& path,
                 const std::vector<FinishedRun>& runs) {
    std::string text = "run_id,cpu_s\n";
    for (const FinishedRun& run : runs)
        text += std::isfinite(run.cpu_s)
                    ? fmt::format("{},{:.3f}\n", run.run_id, run.cpu_s)
                    : fmt::format("{},\n", run.run_id);
    write_text_atomically(path, text);
}

std::map<std::int64_t, double> read_costs(const std::filesystem::path& path) {
    std::map<std::int64_t, double> costs;
    if (!std::filesystem::exists(path)) return costs;
    const CsvTable file = CsvTable::from_file(path);
    for (std::size_t row = 0; row < file.rows(); ++row) {
        const auto id = file.number(row, "run_id");
        const auto cpu_s = file.number(row, "cpu_s");
        if (id && cpu_s) costs[static_cast<std::int64_t>(*id)] = *cpu_s;
    }
    return costs;
}

nlohmann::json json_attribute(const Hdf5Reader& file, const std::filesystem::path& path,
                              const std::string& name) {
    try {
        return nlohmann::json::parse(file.text_attribute(name));
    } catch (const nlohmann::json::exception&) {
        throw InputError(
            fmt::format("{}: attribute \"{}\" is not JSON. Make the file again.",
                        path.string(), name));
    }
}

}  // namespace

void write_database(const std::filesystem::path& path, const Database& database) {
    const std::vector<std::size_t> order = database.design.order_by_run_id();
    std::vector<FinishedRun> runs;
    std::vector<std::int64_t> status, steps, grain_updates;
    std::vector<std::string> reason;
    for (const std::size_t row : order) {
        const FinishedRun& run = database.runs[row];
        runs.push_back(run);
        status.push_back(static_cast<std::int64_t>(run.status));
        reason.push_back(run.reason);
        steps.push_back(run.steps);
        grain_updates.push_back(run.grain_updates);
    }
    write_costs(cost_path(path), runs);

    Hdf5Writer file(path);
    write_design_tables(file, database.design.subset(order));
    file.matrix("outputs",
                table(runs, &FinishedRun::outputs, observe::size_names().size()));
    file.attribute("names", observe::size_names(), "outputs");
    file.matrix("descriptors", table(runs, &FinishedRun::descriptors,
                                     impact::descriptor_names().size()));
    file.attribute("names", impact::descriptor_names(), "descriptors");
    write_outlines(file, runs);
    file.integers("status", status);
    file.texts("reason", reason);
    file.integers("steps", steps);
    file.integers("grain_updates", grain_updates);
    file.attribute("schema", std::string("taylorcal/database/1"));
    file.attribute("configuration", database.configuration.dump());
    file.attribute("provenance", database.provenance.dump());
    file.close();
}

Database read_database(const std::filesystem::path& path) {
    const Hdf5Reader file(path);
    file.expect_schema("taylorcal/database/1");
    Database database;
    database.design = read_design_tables(file, path);
    database.configuration = json_attribute(file, path, "configuration");
    database.provenance = json_attribute(file, path, "provenance");
    const RowMatrix outputs = file.matrix("outputs");
    const RowMatrix descriptors = file.matrix("descriptors");
    const auto status = file.integers("status");
    const auto reason = file.texts("reason");
    const auto steps = file.integers("steps");
    const auto grain_updates = file.integers("grain_updates");
    const std::size_t rows = database.design.rows();
    const auto row_count = static_cast<Eigen::Index>(rows);
    require(
        file.texts_attribute("names", "outputs") == observe::size_names() &&
            file.texts_attribute("names", "descriptors") == impact::descriptor_names(),
        path.string() +
            ": its outputs or descriptors are those of another version. "
            "Make the file again.");
    require(outputs.rows() == row_count && descriptors.rows() == row_count &&
                status.size() == rows && reason.size() == rows && steps.size() == rows &&
                grain_updates.size() == rows,
            path.string() + ": its tables differ in length. Make the file again.");
    const RowMatrix outlines = read_outlines(file, path, row_count);
    const auto costs = read_costs(cost_path(path));
    for (std::size_t row = 0; row < rows; ++row) {
        FinishedRun run;
        run.run_id = database.design.run_id[row];
        run.status = static_cast<impact::Status>(status[row]);
        run.reason = reason[row];
        run.outputs = row_values(outputs, row);
        run.descriptors = row_values(descriptors, row);
        if (outlines.rows() > 0) run.outline_radius = row_values(outlines, row);
        run.steps = steps[row];
        run.grain_updates = grain_updates[row];
        const auto cost = costs.find(run.run_id);
        run.cpu_s =
            cost == costs.end() ? std::numeric_limits<double>::quiet_NaN() : cost->second;
        database.runs.push_back(std::move(run));
    }
    return database;
}

}  // namespace taylorcal::commands
