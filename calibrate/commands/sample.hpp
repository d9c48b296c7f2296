#pragma once

#include "calibrate/commands/study_inputs.hpp"

#include <filesystem>

namespace taylorcal::calibrate {

/// `calibrate sample`: writes posterior.h5 and prints the calibrated parameters.
void sample(const InputPaths& inputs, const std::filesystem::path& out, int threads);

}  // namespace taylorcal::calibrate
