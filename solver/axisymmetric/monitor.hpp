#pragma once

#include "solver/axisymmetric/body.hpp"
#include "solver/impact/impact_result.hpp"

#include <limits>
#include <vector>

namespace taylorcal::axisymmetric {

/// Watches a run: extremes for the descriptors, and the time history.
class Monitor {
  public:
    Monitor(const Body& body, const impact::ImpactCase& impact_case);
    /// To be called after every cycle of steps.
    void observe(const Body& body);
    /// When the next snapshot is due, infinity if never [s].
    double next_snapshot() const { return next_snapshot_; }
    /// Mean axial velocity of the rear face [m/s].
    static double rear_velocity(const Body& body);
    /// What was seen, for the result. `stop_time` in s, NaN if the rear moves still.
    void report(const Body& body, double stop_time, impact::ImpactResult& result) const;

  private:
    void record(const Body& body);

    double record_interval_;
    double snapshot_interval_;
    double next_snapshot_ = std::numeric_limits<double>::infinity();
    std::vector<impact::Fields> snapshots_;
    double next_record_ = 0;
    double last_time_ = 0;     ///< of the last cycle [s]
    double contact_rate_ = 0;  ///< smoothed radial rate of the contact spot [1/s]
    double peak_contact_rate_ = 0;
    double largest_temperature_ = 0;
    double sliding_distance_ = 0;  ///< [m]
    std::vector<impact::HistoryRecord> history_;
    std::vector<double> mean_von_mises_;  ///< of the deforming part, by record [Pa]
};

}  // namespace taylorcal::axisymmetric
