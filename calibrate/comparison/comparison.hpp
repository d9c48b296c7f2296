#pragma once

#include "calibrate/comparison/conflicts.hpp"
#include "calibrate/comparison/curves.hpp"
#include "calibrate/comparison/groups.hpp"
#include "calibrate/comparison/influence.hpp"
#include "calibrate/comparison/misfit.hpp"
#include "calibrate/posterior/summary.hpp"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::calibrate {

/// Where the calibrated model agrees with the measurements and where it fails.
struct Comparison {
    std::vector<ParameterSummary> parameters;
    std::vector<ShotComparison> shots;
    std::vector<ResidualGroup> groups;
    Misfit fitted;
    Misfit held_back;
    std::vector<Conflict> conflicts;
    std::vector<Influence> influence;
    std::vector<Curve> curves;
};

Comparison compare_with_measurements(const ComparisonInputs& inputs);

/// The most telling groups first: those beyond their errors, by whitened rms.
std::vector<std::string> findings(const Comparison& comparison);

/// comparison.json, schema taylorcal/comparison/1.
nlohmann::json to_json(const Comparison& comparison, const ComparisonInputs& inputs);

}  // namespace taylorcal::calibrate
