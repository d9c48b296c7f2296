#include "solver/commands/shot.hpp"

#include "common/errors.hpp"

#include <fmt/core.h>

namespace taylorcal::commands {
namespace {

void require_range(const std::string& where, const std::string& name, double value,
                   double lowest, double highest) {
    require(value >= lowest && value <= highest,
            fmt::format("{}: {} = {} (expected {} to {}). Check the value and its unit.",
                        where, name, value, lowest, highest));
}

}  // namespace

impact::ImpactCase make_case(const Shot& shot, const Configuration& configuration,
                             const std::string& where) {
    require_range(where, "velocity_m_s", shot.velocity_m_s, 1, 1000);
    require_range(where, "initial_diameter_mm", shot.initial_diameter_mm, 0.1, 100);
    require_range(where, "initial_length_mm", shot.initial_length_mm, 0.1, 1000);
    require_range(where, "length_to_diameter",
                  shot.initial_length_mm / shot.initial_diameter_mm, 0.5, 50);
    require_range(where, "initial_temperature_K", shot.initial_temperature_K, 50, 1300);

    constexpr double mm = 1e-3;
    impact::ImpactCase impact_case;
    impact_case.velocity_m_s = shot.velocity_m_s;
    impact_case.initial_temperature_K = shot.initial_temperature_K;
    impact_case.material = configuration.material;
    impact_case.numerics = configuration.numerics;
    impact_case.seed = shot.seed;
    try {
        impact_case.shape = specimen::make_shape(specimen::profile_named(shot.shape),
                                                 mm * shot.initial_diameter_mm,
                                                 mm * shot.initial_length_mm);
        material::check_strength(impact_case.material);
        effects::apply_effects(configuration.effects, impact_case);
    } catch (const InputError& error) {
        throw InputError(where + ": " + error.what());
    }
    return impact_case;
}

}  // namespace taylorcal::commands
