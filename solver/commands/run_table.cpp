#include "solver/commands/run_table.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
namespace taylorcal::commands {
namespace {

using nlohmann::json;

/// NaN and infinity become null, which is what JSON has for them.
json object_of(const std::vector<std::string>& names, const std::vector<double>& values) {
    json object = json::object();
    for (std::size_t i = 0; i < names.size(); ++i) object[names[i]] = values[i];
    return object;
}

std::string specimen_line(const json& description) {
    return fmt::format("{}, {} mm x {} mm, {} K, {} m/s",
                       description["shape"].get<std::string>(),
                       description["initial_diameter_mm"].get<double>(),
                       description["initial_length_mm"].get<double>(),
                       description["initial_temperature_K"].get<double>(),
                       description["velocity_m_s"].get<double>());
}

std::string method_line(const impact::ImpactResult& result, const json& description) {
    const json& configuration = description["configuration"];
    return fmt::format("{}, {}, {} points, {} steps, seed {}",
                       configuration["geometry"].get<std::string>(),
                       configuration["fidelity"].get<std::string>(), result.points,
                       result.steps, description["seed"].get<std::uint64_t>());
}

}  // namespace

std::string status_name(impact::Status status) {
    switch (status) {
        case impact::Status::stopped:
            return "stopped";
        case impact::Status::not_stopped:
            return "not_stopped";
        case impact::Status::over_cpu_limit:
            return "over_cpu_limit";
        case impact::Status::failed:
            break;
    }
    return "failed";
}

json describe(const Shot& shot, const Configuration& configuration, double until_us) {
    return {{"shape", specimen::full_name(shot.shape)},
            {"velocity_m_s", shot.velocity_m_s},
            {"initial_diameter_mm", shot.initial_diameter_mm},
            {"initial_length_mm", shot.initial_length_mm},
            {"initial_temperature_K", shot.initial_temperature_K},
            {"seed", shot.seed},
            {"until_us", until_us},
            {"configuration", configuration.document}};
}

json run_json(const impact::ImpactResult& result, const json& description) {
    const std::vector<std::string> phases(impact::phase_names.begin(),
                                          impact::phase_names.end());
    return {
        {"question", description},
        {"status", status_name(result.status)},
        {"reason", result.reason},
        {"sizes", object_of(observe::size_names(), observe::size_values(result.sizes))},
        {"descriptors", object_of(impact::descriptor_names(),
                                  impact::descriptor_values(result.descriptors))},
        {"points", result.points},
        {"grains_per_point", result.grains_per_point},
        {"steps", result.steps},
        {"grain_updates", result.grain_updates},
        {"neighbours", result.neighbours},
        {"time_shares",
         object_of(phases, {result.phase_shares.begin(), result.phase_shares.end()})},
        {"cpu_s", result.cpu_s}};
}

std::string run_table(const impact::ImpactResult& result, const json& description) {
    std::string text;
    const auto line = [&](const std::string& name, const std::string& value) {
        text += fmt::format("{:<28}{}\n", name, value);
    };
    line("specimen", specimen_line(description));
    line("computed", method_line(result, description));
    line("status", status_name(result.status) +
                       (result.reason.empty() ? "" : ": " + result.reason));
    text += '\n';
    const std::vector<double> sizes = observe::size_values(result.sizes);
    for (std::size_t i = 0; i < sizes.size(); ++i)
        line(observe::size_names()[i], fmt::format("{:.3f}", sizes[i]));
    text += '\n';
    const std::vector<double> descriptors = impact::descriptor_values(result.descriptors);
    for (std::size_t i = 0; i < descriptors.size(); ++i)
        line(impact::descriptor_names()[i], fmt::format("{:.4g}", descriptors[i]));
    text += '\n';
    line("grain_updates",
         fmt::format("{:.3g}", static_cast<double>(result.grain_updates)));
    line("cpu_s", fmt::format("{:.2f}", result.cpu_s));
    return text;
}

}  // namespace taylorcal::commands
