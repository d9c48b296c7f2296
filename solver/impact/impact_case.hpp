#pragma once

#include "solver/impact/additions.hpp"
#include "solver/material/parameters.hpp"
#include "solver/specimen/shape.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace taylorcal::impact {

enum class Geometry { axisymmetric, three_dimensional };  // "axisymmetric", "3d"

/// How finely and how a run is computed.
struct Numerics {
    Geometry geometry = Geometry::axisymmetric;
    int elements_across_radius = 8;  ///< cells, or particles, over the rear radius
    bool refined_mesh = false;  ///< whether the mesh is cut more finely (axisymmetric)
    int grains_per_point = 8;   ///< grains that share a point's strain
    double cfl = 0.28;          ///< share of the stable step
    double linear_viscosity = 0;
    double quadratic_viscosity = 1.0;
    double hourglass = 1;  ///< 1: particles resist it about as the metal resists waves
    double stop_time_limit_s = 400e-6;  ///< simulated time after which a run gives up
    std::int64_t step_limit = 2'000'000;
    std::int64_t point_update_limit = 2'000'000'000;  ///< steps x cells or particles
    double cpu_limit_s = 3600;
};

/// The words users write, in the order of the enumeration and from coarse to fine.
const std::vector<std::string>& geometry_names();
const std::vector<std::string>& fidelity_names();
/// InputError with the nearest name when unknown.
Geometry geometry_from_name(const std::string& name);

/// "coarse", "standard" or "fine" for a geometry. InputError when unknown.
Numerics numerics_for(Geometry geometry, const std::string& fidelity);

/// One Taylor impact: a specimen that flies towards an anvil (z < 0), which is rigid and
/// frictionless unless the additions say otherwise.
struct ImpactCase {
    specimen::Shape shape = specimen::make_shape(specimen::uniform_cylinder);
    double velocity_m_s = 100;
    double initial_temperature_K = 300;
    material::Parameters material;
    Additions additions;  ///< of the effects that are switched on
    Numerics numerics;
    std::uint64_t seed = 1;     ///< of the grain orientations
    double run_until_s = 0;     ///< if positive: stop at this time, not with the rear
    int history_samples = 200;  ///< about as many time records
    double snapshot_interval_s = 0;  ///< if positive: keep the fields so often
};

}  // namespace taylorcal::impact
