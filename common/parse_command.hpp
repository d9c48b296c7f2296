#pragma once

#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal {

/// InputError if the first word of a command line is not a subcommand. CLI11 would say
/// that one is missing.
inline void require_subcommand(CLI::App& app, int argc, char** argv) {
    const std::string word = argc > 1 ? argv[1] : "-";
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
        names.push_back(command->get_name());
    require(word.starts_with("-") ||
                std::find(names.begin(), names.end(), word) != names.end(),
            fmt::format("\"{}\" is no subcommand{}. There are: {}.", word,
                        nearest_hint(word, names, " (is \"", "\" meant?)"),
                        fmt::join(names, ", ")));
}

/// Parses a command line. Returns the exit status when nothing is left to do: help was
/// asked for, or the use is wrong and was told so.
inline std::optional<int> parse_command(CLI::App& app, int argc, char** argv) {
    require_subcommand(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 1;
    }
    return std::nullopt;
}

}  // namespace taylorcal
