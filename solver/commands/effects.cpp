#include "solver/commands/effects.hpp"

#include "solver/effects/effect_list.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace taylorcal::commands {
namespace {

using effects::Effect;

std::vector<std::string> geometries_of(const Effect& effect) {
    std::vector<std::string> names;
    for (const impact::Geometry geometry : effect.geometries)
        names.push_back(impact::geometry_names()[static_cast<std::size_t>(geometry)]);
    return names;
}

nlohmann::json effects_json() {
    nlohmann::json list = nlohmann::json::array();
    for (const Effect& effect : effects::effect_list())
        list.push_back({{"name", effect.name},
                        {"symbol", effect.symbol},
                        {"equation", effect.equation},
                        {"unit", effect.unit},
                        {"lowest", effect.lowest},
                        {"highest", effect.highest},
                        {"prior",
                         {{"kind", effects::prior_name(effect.prior.kind)},
                          {"scale", effect.prior.scale}}},
                        {"signed", effect.is_signed},
                        {"typical", effect.typical},
                        {"acts_on", effects::acts_on_name(effect.acts_on)},
                        {"geometries", geometries_of(effect)},
                        {"description", effect.description},
                        {"source", effect.source}});
    return {{"effects", list}};
}

std::string effects_table() {
    constexpr const char* row = "{:<22}{:<8}{:<11}{:<14}{:<18}{:<8}  {}\n";
    std::string text = fmt::format(row, "name", "symbol", "unit", "range", "prior",
                                   "typical", "equation: description [source]");
    for (const Effect& effect : effects::effect_list()) {
        std::string what = fmt::format("{}: {} [{}]", effect.equation, effect.description,
                                       effect.source);
        if (effect.geometries.size() == 1)
            what = geometries_of(effect).front() + " only; " + what;
        text += fmt::format(row, effect.name, effect.symbol, effect.unit,
                            fmt::format("{:g} .. {:g}", effect.lowest, effect.highest),
                            fmt::format("{} {:g}", effects::prior_name(effect.prior.kind),
                                        effect.prior.scale),
                            fmt::format("{:g}", effect.typical), what);
    }
    return text +
           "\nAt amplitude 0 each is absent. Set them by --set name=amplitude, by "
           "\"effects\" in\nsolver.json, or by a column of a design.\n";
}

}  // namespace

void add_effects(CLI::App& app) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand(
        "effects", "List the physical effects that can be switched on");
    command->add_flag("--json", *json, "print JSON instead of a table");
    command->footer("Sample runs:\n  solver effects\n  solver effects --json");
    command->callback([json] {
        fmt::print("{}", *json ? effects_json().dump(2) + "\n" : effects_table());
    });
}

}  // namespace taylorcal::commands
