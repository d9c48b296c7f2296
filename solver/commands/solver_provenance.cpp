#include "solver/commands/solver_provenance.hpp"

#include "common/provenance.hpp"
#include "solver/material/network_equation_of_state.hpp"

#include <nlohmann/json.hpp>

namespace taylorcal::commands {

nlohmann::json solver_provenance(std::uint64_t seed,
                                 const nlohmann::json& configuration) {
    nlohmann::json record = provenance("solver", seed, configuration);
    // The question of one run holds the configuration that a batch has alone.
    const nlohmann::json settings = configuration.value("configuration", configuration);
    const nlohmann::json material = settings.value("material", nlohmann::json::object());
    if (material.value("equation_of_state", "") == "copper_md")
        record["equation_of_state_network_digest"] = material::copper_md_digest();
    return record;
}

}  // namespace taylorcal::commands
