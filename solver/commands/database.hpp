#pragma once

#include "solver/commands/design.hpp"
#include "solver/commands/finished_run.hpp"

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

namespace taylorcal::commands {

/// Finished runs with their inputs (schema taylorcal/database/1), row by row.
struct Database {
    Design design;
    std::vector<FinishedRun> runs;  ///< runs[i] answers row i of the design
    nlohmann::json configuration;   ///< solver.json
    nlohmann::json provenance;
};

/// Writes the rows sorted by run_id, and beside the file `<path>.cost.csv` with the
/// processor time of each run, which differs from one computation to the next.
void write_database(const std::filesystem::path& path, const Database& database);

/// Reads a database; processor times are NaN where its cost table is missing.
Database read_database(const std::filesystem::path& path);

}  // namespace taylorcal::commands
