#pragma once

#include <cstdint>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::commands {

/// provenance() of the solver; with the digest of the network that its equation of state
/// asks, if the configuration (of a batch, or within the question of one run) names one.
nlohmann::json solver_provenance(std::uint64_t seed, const nlohmann::json& configuration);

}  // namespace taylorcal::commands
