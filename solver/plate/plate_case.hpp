#pragma once

#include "solver/material/parameters.hpp"

#include <cstdint>

namespace taylorcal::plate {

/// A flyer plate that hits a target of the same metal at time zero. Lateral motion is
/// blocked, as in the middle of a plate much wider than thick. SI units.
struct PlateCase {
    double flyer_thickness = 0;  ///< [m]
    double target_thickness = 0;
    double velocity = 0;  ///< of the flyer [m/s]
    double duration = 0;  ///< [s]
    double cell = 5e-6;   ///< largest height of a cell [m]
    double initial_temperature_K = 300;
    material::Parameters material;
    std::uint64_t seed = 1;  ///< of the grain orientations
};

}  // namespace taylorcal::plate
