#pragma once

#include "solver/commands/cli_app.hpp"

namespace taylorcal::commands {

/// Adds `solver parameters`: every constant of the material, as a table or JSON.
void add_parameters(CLI::App& app);

}  // namespace taylorcal::commands
