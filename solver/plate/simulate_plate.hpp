#pragma once

#include "solver/plate/plate_case.hpp"

#include <cstdint>
#include <vector>

namespace taylorcal::plate {

/// One moment of an experiment. SI units.
struct PlateRecord {
    double time;
    double free_surface_velocity;  ///< of the target's rear
    double interface_velocity;     ///< of the target's struck face
};

struct PlateResult {
    std::vector<PlateRecord> history;  ///< every step
    double largest_stress = 0;         ///< compressive, in the middle of the target [Pa]
    double largest_tension = 0;        ///< anywhere: no spall in the model [Pa]
    double largest_temperature_K = 0;
    double energy_error = 0;  ///< |gained or lost| / initial kinetic
    std::int64_t steps = 0;
};

/// Follows the column cell by cell (staggered grid of von Neumann and Richtmyer, doi
/// 10.1063/1.1699639), a block of grains a cell that share its strain; flyer and target
/// separate where the contact would pull. NumericalError when the state is not finite.
PlateResult simulate_plate(const PlateCase& plate_case);

}  // namespace taylorcal::plate
