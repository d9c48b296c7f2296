#pragma once

#include "solver/impact/impact_result.hpp"
#include "solver/sph/body.hpp"
#include "solver/sph/outline.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace taylorcal::sph {

/// Watches a run: time history, descriptors, and the fields at the end.
class Monitor {
  public:
    Monitor(const impact::ImpactCase& impact_case, const Body& body);

    /// Adds a record of this moment.
    void record();
    /// Mean axial velocity of the rear eighth of the length [m/s].
    double rear_velocity() const;
    const Outline& outline() const { return outline_; }
    const std::vector<impact::HistoryRecord>& history() const { return history_; }
    impact::Descriptors descriptors(std::optional<double> stop_time_s) const;
    impact::Fields fields() const;

  private:
    double von_mises(std::size_t slot) const;
    double largest_temperature() const;
    double mean_von_mises_of_deformed_part() const;
    double sliding_distance() const;

    const Body& body_;
    Outline outline_;
    double initial_kinetic_energy_;
    double spot_radius_;    // at the last record [m]
    double spot_time_ = 0;  // of it [s]
    double largest_temperature_ = 0;
    std::vector<std::size_t> rear_;                     // slots
    std::vector<std::pair<double, double>> von_mises_;  // time [s], mean [Pa]
    std::vector<impact::HistoryRecord> history_;
};

}  // namespace taylorcal::sph
