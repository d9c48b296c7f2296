#pragma once

#include "calibrate/diagnosis/diagnosis.hpp"
#include "calibrate/diagnosis/next_experiment.hpp"

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::calibrate {

/// What diagnosis.json says besides the diagnosis itself.
struct DiagnosisFacts {
    std::string errors_in_words;
    std::size_t signature_points = 0;
    /// Relative leave-one-out error of each candidate's signature fit.
    std::vector<double> signature_residual_sd;
    std::vector<std::vector<double>> mode_parameters;  ///< plain, by mode
    std::vector<NextExperiment> next_experiments;
};

/// diagnosis.json, schema taylorcal/diagnosis/1, but for its provenance.
nlohmann::json to_json(const DiagnosisProblem& problem, const Diagnosis& diagnosis,
                       const DiagnosisFacts& facts);
nlohmann::json to_json(const std::vector<NextExperiment>& experiments);

}  // namespace taylorcal::calibrate
