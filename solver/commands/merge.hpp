#pragma once

#include "solver/commands/cli_app.hpp"
#include "solver/commands/database.hpp"

#include <string>
#include <vector>

namespace taylorcal::commands {

/// Joins databases of one design. Where an input of `zero_inputs` is missing, it becomes
/// the last column and is 0: rows that were computed before an effect was added.
/// InputError when the databases differ in configuration or inputs or share a run.
Database merge(const std::vector<std::string>& paths,
               const std::vector<std::string>& zero_inputs = {});

/// Adds `solver merge`: chunks of a database into one.
void add_merge(CLI::App& app);

}  // namespace taylorcal::commands
