#pragma once

#include "solver/impact/phase_clock.hpp"
#include "solver/observe/sizes.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace taylorcal::impact {

/// How a run ended; 0, 1, 2, 3 in the database. `over_cpu_limit` was cut short after so
/// much processor time, which another machine might not have needed.
enum class Status { stopped, not_stopped, failed, over_cpu_limit };

/// Extremes and integrals over a run that help to say where a model fails. Four are read
/// otherwise off cells in (r, z) than off particles in 3D; compare them within a
/// geometry.
struct Descriptors {
    /// When the rear's axial velocity crosses zero; NaN, as is the stress at half of it,
    /// in a run that ended before.
    double stop_time_us = std::numeric_limits<double>::quiet_NaN();
    /// (r, z): at the end of any cycle; 3D: at any record of the history.
    double largest_temperature_K = 0;
    /// Of the contact spot. (r, z): velocity over radius of the rim node, averaged over 1
    /// us; 3D: growth between two records of the radius that the lowest layer's second
    /// moment has.
    double peak_strain_rate_per_s = 0;
    double plastic_work_J = 0;
    /// Largest radial travel at the anvil. (r, z): of the foot's nodes, at any time and
    /// either way; 3D: of the particles of the two lowest layers, outwards, at the end.
    double sliding_distance_mm = 0;
    double smallest_grain_um = 0;
    double largest_weakened_fraction = 0;
    double largest_plastic_strain = 0;  ///< equivalent
    /// By mass, at half the stop time. (r, z): of the cells with a plastic rate above 1e3
    /// 1/s, at the last record before; 3D: of the particles with a plastic strain above
    /// 0.05, between every tenth record.
    double mean_von_mises_GPa = std::numeric_limits<double>::quiet_NaN();
    double viscous_share = 0;  ///< artificial viscosity's share of the work
    double hourglass_share = 0;
    double energy_error = 0;  ///< |energy gained or lost| / initial kinetic
};
const std::vector<std::string>& descriptor_names();
std::vector<double> descriptor_values(const Descriptors& descriptors);

/// One record of the time history.
struct HistoryRecord {
    double time_us;
    double length_mm;
    double foot_radius_mm;
    double rear_velocity_m_s;
    double radial_strain_rate_per_s;
    double largest_temperature_K;
    double kinetic_energy_J;
    double total_energy_J;
};

/// Fields of one moment, one entry a particle or cell; positions in mm (axisymmetric: y =
/// 0).
struct Fields {
    double time_us = 0;
    std::vector<double> x_mm, y_mm, z_mm;
    std::vector<double> initial_x_mm, initial_y_mm, initial_z_mm;
    std::vector<double> volume_mm3;
    std::vector<double> equivalent_plastic_strain;
    std::vector<double> temperature_K;
    std::vector<double> von_mises_GPa;
    std::vector<double> pressure_GPa;
    std::vector<double> grain_diameter_um;
    std::vector<double> weakened_fraction;
    /// Of each cell r1, z1, ... r4, z4 around it; empty for particles.
    std::vector<std::array<double, 8>> corners_mm;
};

struct ImpactResult {
    Status status = Status::failed;
    std::string reason;  ///< why it is not `stopped`, empty otherwise
    observe::Sizes sizes;
    Descriptors descriptors;
    observe::DeformedProfile profile;  ///< the outline
    /// observe::sample_outline over the moments of `sizes`; empty when nothing was read.
    std::vector<double> outline_radius;
    std::vector<HistoryRecord> history;
    Fields fields;                  ///< at the end
    std::vector<Fields> snapshots;  ///< on the way, and at the end; if asked for
    std::int64_t steps = 0;         ///< the finest, where points take their own
    std::int64_t points = 0;        ///< particles or cells
    int grains_per_point = 0;
    std::int64_t grain_updates = 0;  ///< made, of single grains by a step
    std::array<double, phase_names.size()> phase_shares{};  ///< of the time, by phase
    double neighbours = 0;  ///< mean number of a particle, or of a cell's nodes
    double cpu_s = 0;
};

}  // namespace taylorcal::impact
