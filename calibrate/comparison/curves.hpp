#pragma once

#include "calibrate/comparison/shot_comparison.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// The model against velocity for one lot, geometry and size, lengths in mm.
struct Curve {
    std::string lot, shape, size;
    double initial_diameter_mm = 0;
    double initial_length_mm = 0;
    double initial_temperature_K = 0;
    std::vector<double> velocity_m_s{};
    std::vector<double> predicted{};  ///< at the best maximum
    std::vector<double> mean{};       ///< over the posterior's draws
    std::vector<double> lower{};      ///< 95 % band of the model
    std::vector<double> upper{};
};

/// Over the velocities of each lot and 5 % beyond, inside the predictor's range.
std::vector<Curve> predict_curves(const ComparisonInputs& inputs);

}  // namespace taylorcal::calibrate
