#pragma once

#include "calibrate/commands/study_inputs.hpp"

#include <filesystem>

namespace taylorcal::calibrate {

/// `calibrate compare`: writes comparison.json and prints what stands out.
void compare(const InputPaths& inputs, const std::filesystem::path& posterior,
             const std::filesystem::path& out);

}  // namespace taylorcal::calibrate
