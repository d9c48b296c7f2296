#pragma once

#include "calibrate/measurements/shot.hpp"

#include <filesystem>
#include <vector>

namespace taylorcal::calibrate {

/// Reads and checks a measurement table; every row is checked, also the ignored ones.
/// InputError names file, line, column, value, what was expected and the remedy.
std::vector<Shot> read_measurements(const std::filesystem::path& path);

}  // namespace taylorcal::calibrate
