#pragma once

#include "calibrate/commands/study_inputs.hpp"

#include <filesystem>

namespace taylorcal::calibrate {

/// What a diagnosis takes besides the files of a calibration.
struct DiagnosisPaths {
    std::filesystem::path posterior;
    std::filesystem::path signatures;
    std::filesystem::path finer;  ///< empty: the solver's resolution is not counted
    std::filesystem::path candidates;
};

/// `calibrate diagnose`: writes diagnosis.json and prints its verdict.
void diagnose(const InputPaths& inputs, const DiagnosisPaths& paths,
              const std::filesystem::path& out, int threads);

/// `calibrate design`: writes the shots that best tell apart the explanations that
/// `diagnosis` names.
void design(const InputPaths& inputs, const DiagnosisPaths& paths,
            const std::filesystem::path& diagnosis, const std::filesystem::path& out,
            int threads);

}  // namespace taylorcal::calibrate
