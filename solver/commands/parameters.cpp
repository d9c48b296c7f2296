#include "solver/commands/parameters.hpp"

#include "solver/material/parameters.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace taylorcal::commands {
namespace {

using material::ParameterInfo;

double default_of(const ParameterInfo& info) {
    return material::Parameters{}.*info.member;
}

nlohmann::json as_json() {
    nlohmann::json list = nlohmann::json::array();
    for (const ParameterInfo& info : material::parameter_list())
        list.push_back({{"name", info.name},
                        {"symbol", info.symbol},
                        {"unit", info.unit},
                        {"lowest", info.lowest},
                        {"highest", info.highest},
                        {"default", default_of(info)},
                        {"calibrated", info.calibrated},
                        {"description", info.description},
                        {"source", info.source}});
    return {{"parameters", list},
            {"models",
             {{"strength", material::strength_names()},
              {"equation_of_state", material::equation_of_state_names()}}}};
}

std::string as_table() {
    constexpr const char* row = "{:<26}{:<10}{:<9}{:>10}  {:<16}  {}\n";
    std::string text = fmt::format(row, "name", "symbol", "unit", "default", "range",
                                   "description [source]");
    for (const ParameterInfo& info : material::parameter_list())
        text +=
            fmt::format(row, info.name, info.symbol, info.unit,
                        fmt::format("{:.4g}", default_of(info)),
                        fmt::format("{:.4g} .. {:.4g}", info.lowest, info.highest),
                        fmt::format("{}{} [{}]", info.calibrated ? "calibrated: " : "",
                                    info.description, info.source));
    text += fmt::format(
        "\nstrength: {}\nequation_of_state: {}\nRodionov 2023: doi 10.3390/ma16165602\n",
        fmt::join(material::strength_names(), ", "),
        fmt::join(material::equation_of_state_names(), ", "));
    return text;
}

}  // namespace

void add_parameters(CLI::App& app) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("parameters", "List the material's constants");
    command->add_flag("--json", *json, "print JSON instead of a table");
    command->footer("Sample runs:\n  solver parameters\n  solver parameters --json");
    command->callback(
        [json] { fmt::print("{}", *json ? as_json().dump(2) + "\n" : as_table()); });
}

}  // namespace taylorcal::commands
