#pragma once

#include "calibrate/comparison/joint_errors.hpp"
#include "calibrate/measurements/velocity_thirds.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// Of all shots compared, fitted or held back.
ThirdsOfVelocity thirds_of(const std::vector<ShotComparison>& shots);

/// Residuals of the data that share a property.
struct ResidualGroup {
    std::string by;    ///< "size", "shape", "lot", "velocity_third", "use", ...
    std::string key;   ///< its value; parts of a combination are joined by " x "
    std::string size;  ///< the one size of all its data, or empty
    /// The one shape of all its data; empty if several, or if the table has no other.
    std::string shape;
    std::string velocity_third;  ///< the one third of all its data, or empty
    std::size_t n = 0;
    double rms_relative = 0;
    double mean_relative = 0;  ///< of (measured - predicted) / scale
    double mean_standardised = 0;
    double mean_standardised_sd = 0;  ///< standard error, from the errors' covariance
    double mean_whitened = 0;
    double whitened_rms = 0;
    double whitened_rms_sd = 0;  ///< standard error about 1, likewise
    std::string words{};
};

/// By size, shape, lot, velocity third and use, and by shape x size x velocity third, in
/// order of first appearance.
std::vector<ResidualGroup> group_residuals(const std::vector<ShotComparison>& shots,
                                           const std::vector<std::string>& sizes,
                                           const JointErrors& errors);

}  // namespace taylorcal::calibrate
