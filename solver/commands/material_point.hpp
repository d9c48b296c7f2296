#pragma once

#include "solver/commands/deformation_path.hpp"
#include "solver/material/strength.hpp"

#include <array>
#include <string>
#include <vector>

namespace taylorcal::commands {

/// The state of the grain at one time, SI units.
struct PointRecord {
    double time;
    std::array<double, 6> stress_deviator;  ///< xx yy zz xy xz yz, lab frame
    double temperature;
    material::GrainState grain;
};

/// Moves one grain along the path with the strength model and the energy balance of the
/// impact solvers, in double precision. Between two records the steps are equal and no
/// longer than the path's. NumericalError when the state is no longer finite.
std::vector<PointRecord> follow(const DeformationPath& path);

/// The records as a comma-separated table; each number reads back exactly.
std::string to_csv(const std::vector<PointRecord>& records);

}  // namespace taylorcal::commands
