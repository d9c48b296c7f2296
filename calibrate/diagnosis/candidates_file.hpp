#pragma once

#include "calibrate/diagnosis/candidate.hpp"

#include <filesystem>
#include <vector>

namespace taylorcal::calibrate {

/// Reads candidates.json strictly. InputError names file, key, value and remedy.
std::vector<Candidate> read_candidates(const std::filesystem::path& path);

}  // namespace taylorcal::calibrate
