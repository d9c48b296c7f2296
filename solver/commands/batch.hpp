#pragma once

#include "solver/commands/cli_app.hpp"
#include "solver/commands/database.hpp"
#include "solver/commands/run_cache.hpp"

#include <filesystem>
#include <functional>

namespace taylorcal::commands {

using Simulate = std::function<impact::ImpactResult(const impact::ImpactCase&)>;

/// Computes every row of `design` that neither `<out>.journal.jsonl` nor the cache holds,
/// on `threads` threads, and writes the database. A run that throws becomes a failed row.
/// The same rows give the same bytes for any number of threads and interruptions.
void run_batch(const Design& design, const std::vector<impact::ImpactCase>& cases,
               const nlohmann::json& configuration, const std::filesystem::path& out,
               int threads, const Simulate& simulate, RunCache cache = {});

/// Adds `solver batch`: many impacts in parallel, resumable.
void add_batch(CLI::App& app);

}  // namespace taylorcal::commands
