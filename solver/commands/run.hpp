#pragma once

#include <CLI/CLI.hpp>

namespace taylorcal::commands {

/// Adds `solver run`: one impact, its sizes and fields.
void add_run(CLI::App& app);

}  // namespace taylorcal::commands
