#pragma once

#include "solver/commands/cli_app.hpp"

namespace taylorcal::commands {

/// Adds `solver run`: one impact, its sizes and fields.
void add_run(CLI::App& app);

}  // namespace taylorcal::commands
