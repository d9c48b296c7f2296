#include "solver/material/parameters.hpp"

#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace taylorcal::material {
namespace {

[[noreturn]] void fail_unknown(std::string_view what, std::string_view word,
                               const std::vector<std::string>& known,
                               const std::string& remedy) {
    throw InputError(fmt::format("{} \"{}\" is unknown{}. {}", what, word,
                                 nearest_hint(word, known), remedy));
}

const ParameterInfo& find_parameter(std::string_view name) {
    const auto& list = parameter_list();
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const auto& info) { return info.name == name; });
    if (found == list.end())
        fail_unknown("material parameter", name, setting_names(),
                     "\"solver parameters\" lists them all.");
    return *found;
}

template <class Model>
Model model_from_word(std::string_view what, std::string_view word,
                      const std::vector<std::string>& known) {
    const auto found = std::find(known.begin(), known.end(), word);
    if (found == known.end())
        fail_unknown(what, word, known, fmt::format("Use {}.", fmt::join(known, ", ")));
    return static_cast<Model>(found - known.begin());
}

}  // namespace

const std::vector<std::string>& strength_names() {
    static const std::vector<std::string> names = {"dislocation", "j2", "johnson_cook",
                                                   "elastic"};
    return names;
}

const std::vector<std::string>& equation_of_state_names() {
    static const std::vector<std::string> names = {"copper", "linear", "copper_md"};
    return names;
}

const std::vector<std::string>& setting_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list = {"strength", "equation_of_state"};
        for (const ParameterInfo& info : parameter_list()) list.push_back(info.name);
        return list;
    }();
    return names;
}

void set_model(Parameters& parameters, std::string_view name, std::string_view word) {
    if (name == "strength")
        parameters.strength =
            model_from_word<StrengthModel>(name, word, strength_names());
    else if (name == "equation_of_state")
        parameters.equation_of_state =
            model_from_word<EquationOfStateModel>(name, word, equation_of_state_names());
    else
        throw InputError(fmt::format("{} = \"{}\" (expected a number).",
                                     find_parameter(name).name, word));
}

void set_parameter(Parameters& parameters, std::string_view name, double value) {
    const ParameterInfo& info = find_parameter(name);
    require(value >= info.lowest && value <= info.highest,
            fmt::format(
                "{} = {:.10g}{} is out of its range (expected {:g} to {:g}). \"solver "
                "parameters\" lists the ranges.",
                name, value, info.unit == "1" ? "" : " " + info.unit, info.lowest,
                info.highest));
    parameters.*info.member = value;
}

void check_melting_temperature(const Parameters& parameters) {
    require(
        parameters.jc_melting_temperature > parameters.reference_temperature,
        fmt::format("jc_melting_temperature = {:.10g} K is not above "
                    "reference_temperature = {:.10g} K, from which metal softens. "
                    "Raise the first or lower the second.",
                    parameters.jc_melting_temperature, parameters.reference_temperature));
}

void check_strength(const Parameters& parameters) {
    if (parameters.strength == StrengthModel::johnson_cook)
        check_melting_temperature(parameters);
}

}  // namespace taylorcal::material
