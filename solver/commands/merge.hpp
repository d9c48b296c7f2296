#pragma once

#include "solver/commands/cli_app.hpp"
#include "solver/commands/database.hpp"

#include <string>
#include <vector>

namespace taylorcal::commands {

/// Joins databases of one design. InputError when they differ in configuration or inputs
/// or share a run.
Database merge(const std::vector<std::string>& paths);

/// Adds `solver merge`: chunks of a database into one.
void add_merge(CLI::App& app);

}  // namespace taylorcal::commands
