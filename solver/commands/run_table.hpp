#pragma once

#include "solver/commands/shot.hpp"
#include "solver/impact/impact_result.hpp"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::commands {

/// The whole question that a run answers: shot, configuration and seed.
nlohmann::json describe(const Shot& shot, const Configuration& configuration,
                        double until_us);

/// What a run gave, for machines: sizes, descriptors, status, cost.
nlohmann::json run_json(const impact::ImpactResult& result,
                        const nlohmann::json& description);

/// The same as tables for people.
std::string run_table(const impact::ImpactResult& result,
                      const nlohmann::json& description);

/// "stopped", "not_stopped", "over_cpu_limit" or "failed".
std::string status_name(impact::Status status);

}  // namespace taylorcal::commands
