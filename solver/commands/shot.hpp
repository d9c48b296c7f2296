#pragma once

#include "solver/commands/configuration.hpp"

#include <cstdint>
#include <string>

namespace taylorcal::commands {

/// One shot as users describe it, in the units of its names.
struct Shot {
    std::string shape = "uniform_cylinder";  ///< as `specimen::profile_named` takes it
    double velocity_m_s = 100;
    double initial_diameter_mm = 8;
    double initial_length_mm = 40;
    double initial_temperature_K = 300;
    std::uint64_t seed = 1;
};

/// The case to simulate. InputError that begins with `where` when a figure makes no
/// sense.
impact::ImpactCase make_case(const Shot& shot, const Configuration& configuration,
                             const std::string& where);

}  // namespace taylorcal::commands
