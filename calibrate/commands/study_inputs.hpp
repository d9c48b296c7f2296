#pragma once

#include "calibrate/measurements/data_set.hpp"
#include "calibrate/prediction/network_predictor.hpp"
#include "calibrate/sampling/parameter_space.hpp"
#include "calibrate/settings/settings.hpp"

#include <filesystem>

namespace taylorcal::calibrate {

/// The files that all subcommands take.
struct InputPaths {
    std::filesystem::path settings;
    std::filesystem::path measurements;
    std::filesystem::path emulator;
};

/// The same, read and checked against each other.
struct StudyInputs {
    Settings settings;
    DataSet set;
    ParameterSpace space;
    NetworkPredictor predictor;

    explicit StudyInputs(const InputPaths& paths);
};

}  // namespace taylorcal::calibrate
