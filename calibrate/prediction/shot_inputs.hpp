#pragma once

#include "calibrate/measurements/shot.hpp"

#include <string>

namespace taylorcal::calibrate {

/// Whether a network input of this name comes from the measurement table.
bool is_shot_input(const std::string& name);

/// Its value for a shot, in the unit that the name carries.
double shot_input(const std::string& name, const Shot& shot);

}  // namespace taylorcal::calibrate
