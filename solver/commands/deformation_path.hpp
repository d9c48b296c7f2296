#pragma once

#include "common/json_reader.hpp"
#include "solver/material/parameters.hpp"

#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::commands {

/// A stretch of time with a constant velocity gradient.
struct PathSegment {
    Eigen::Matrix3d velocity_gradient;  ///< L_ij = dv_i/dx_j in the lab frame [1/s]
    double duration;                    ///< [s]
    long long outputs;  ///< rows, at duration x k/outputs for k = 1 to outputs
};

/// What one grain undergoes.
struct DeformationPath {
    material::Parameters parameters;
    Eigen::Quaterniond orientation;  ///< crystal frame to lab frame
    double time_step;                ///< largest step [s]
    std::vector<PathSegment> segments;
};

/// Reads the object strictly: `equation_of_state`, `orientation_quaternion_wxyz`,
/// `time_step_s` and `segments` are needed, `parameters` and `strength` optional.
DeformationPath read_deformation_path(const JsonReader& reader);

}  // namespace taylorcal::commands
