#pragma once

#include "solver/commands/cli_app.hpp"

namespace taylorcal::commands {

/// Adds `solver point PATH.json --out curve.csv`: the material alone, on a prescribed
/// path of deformation.
void add_point(CLI::App& app);

}  // namespace taylorcal::commands
