#pragma once

#include "solver/commands/cli_app.hpp"

namespace taylorcal::commands {

/// Adds `solver effects`: every effect that a run can be given, as a table or JSON.
void add_effects(CLI::App& app);

}  // namespace taylorcal::commands
