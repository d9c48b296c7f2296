#include "solver/commands/finished_run.hpp"

#include "common/errors.hpp"
#include "solver/observe/outline.hpp"

#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal::commands {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> finite_or_nan(std::vector<double> values) {
    for (double& value : values)
        if (!std::isfinite(value)) value = nan;
    return values;
}

/// The list of `count` numbers under a key. JSON has no NaN: it is written as null.
std::vector<double> numbers_or_nan(const nlohmann::json& line, const std::string& key,
                                   std::size_t count) {
    const nlohmann::json& list = line.at(key);
    require(list.is_array() && list.size() == count,
            fmt::format("{} has {} entries (expected {})", key, list.size(), count));
    std::vector<double> values;
    for (const auto& entry : list)
        values.push_back(entry.is_null() ? nan : entry.get<double>());
    return values;
}

}  // namespace

FinishedRun row_of(std::int64_t run_id, const impact::ImpactResult& result) {
    FinishedRun run;
    run.run_id = run_id;
    run.status = result.status;
    run.reason = result.reason;
    run.outputs = finite_or_nan(observe::size_values(result.sizes));
    run.descriptors = finite_or_nan(impact::descriptor_values(result.descriptors));
    run.outline_radius.assign(observe::outline_points, nan);
    if (run.status != impact::Status::failed && !result.outline_radius.empty())
        run.outline_radius = finite_or_nan(result.outline_radius);
    run.steps = result.steps;
    run.grain_updates = result.grain_updates;
    run.cpu_s = result.cpu_s;
    return run;
}

FinishedRun failed_row(std::int64_t run_id, const std::string& reason) {
    FinishedRun run;
    run.run_id = run_id;
    run.reason = reason;
    run.outputs.assign(observe::size_names().size(), nan);
    run.descriptors.assign(impact::descriptor_names().size(), nan);
    run.outline_radius.assign(observe::outline_points, nan);
    return run;
}

nlohmann::json to_json(const FinishedRun& run) {
    return {{"run_id", run.run_id},
            {"status", static_cast<int>(run.status)},
            {"reason", run.reason},
            {"outputs", run.outputs},
            {"descriptors", run.descriptors},
            {"outline_radius", run.outline_radius},
            {"steps", run.steps},
            {"grain_updates", run.grain_updates},
            {"cpu_s", run.cpu_s}};
}

FinishedRun run_from_json(const nlohmann::json& line) {
    FinishedRun run;
    run.run_id = line.at("run_id").get<std::int64_t>();
    const int status = line.at("status").get<int>();
    require(status >= 0 && status <= static_cast<int>(impact::Status::over_cpu_limit),
            fmt::format("status = {} (expected 0 to 3)", status));
    run.status = static_cast<impact::Status>(status);
    run.reason = line.at("reason").get<std::string>();
    run.outputs = numbers_or_nan(line, "outputs", observe::size_names().size());
    run.descriptors =
        numbers_or_nan(line, "descriptors", impact::descriptor_names().size());
    run.outline_radius = numbers_or_nan(line, "outline_radius", observe::outline_points);
    run.steps = line.at("steps").get<std::int64_t>();
    run.grain_updates = line.at("grain_updates").get<std::int64_t>();
    run.cpu_s = line.at("cpu_s").get<double>();
    return run;
}

}  // namespace taylorcal::commands
