#include "solver/axisymmetric/monitor.hpp"

#include "solver/axisymmetric/dynamics.hpp"
#include "solver/axisymmetric/profile.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::axisymmetric {
namespace {

// The contact spot's rate is averaged over this time, so that the ringing of single nodes
// just after the impact does not count as a peak.
constexpr double rate_average_time = 1e-6;
constexpr double deforming_rate = 1e3;  // a cell above this plastic rate counts [1/s]

}  // namespace

Monitor::Monitor(const Body& body, const impact::ImpactCase& impact_case)
    : record_interval_(impact_case.numerics.stop_time_limit_s / 2 /
                       std::max(1, impact_case.history_samples)),
      snapshot_interval_(impact_case.snapshot_interval_s) {
    record(body);
    if (snapshot_interval_ <= 0) return;
    snapshots_.push_back(fields(body));
    next_snapshot_ = snapshot_interval_;
}

double Monitor::rear_velocity(const Body& body) {
    double momentum = 0;
    double mass = 0;
    for (const std::size_t n : body.mesh.rear) {
        momentum += body.node_mass[n] * body.axial_velocity[n];
        mass += body.node_mass[n];
    }
    return momentum / mass;
}

void Monitor::observe(const Body& body) {
    const std::size_t rim = body.mesh.foot.back();
    const double share = std::min(1.0, (body.time - last_time_) / rate_average_time);
    last_time_ = body.time;
    contact_rate_ +=
        share * (body.radial_velocity[rim] / body.radius[rim] - contact_rate_);
    peak_contact_rate_ = std::max(peak_contact_rate_, contact_rate_);
    for (const auto& thermo : body.thermo)
        largest_temperature_ = std::max(largest_temperature_, thermo.temperature);
    for (const std::size_t n : body.mesh.foot) {
        sliding_distance_ = std::max(sliding_distance_,
                                     std::abs(body.radius[n] - body.mesh.node_radius[n]));
    }
    if (body.time >= next_record_) record(body);
    if (body.time >= next_snapshot_ * (1 - 1e-9)) {
        snapshots_.push_back(fields(body));
        next_snapshot_ += snapshot_interval_;
    }
}

void Monitor::record(const Body& body) {
    next_record_ = body.time + record_interval_;
    const double low = *std::min_element(body.height.begin(), body.height.end());
    const double high = body.height[body.mesh.rear.front()];
    const double kinetic = kinetic_energy(body);
    double temperature = 0;
    double von_mises = 0;
    double mass = 0;
    for (std::size_t c = 0; c < body.cells(); ++c) {
        temperature = std::max(temperature, body.thermo[c].temperature);
        if (body.plastic_rate[c] < deforming_rate) continue;
        von_mises += body.cell_mass[c] * von_mises_stress(body.deviator[c]);
        mass += body.cell_mass[c];
    }
    mean_von_mises_.push_back(mass > 0 ? von_mises / mass : 0);
    history_.push_back({body.time * 1e6, (high - low) * 1e3,
                        body.radius[body.mesh.foot.back()] * 1e3, rear_velocity(body),
                        contact_rate_, temperature, kinetic,
                        kinetic + body.balance.internal + body.balance.hourglass +
                            body.balance.contact});
}

void Monitor::report(const Body& body, double stop_time,
                     impact::ImpactResult& result) const {
    const EnergyBalance& balance = body.balance;
    impact::Descriptors& d = result.descriptors;
    result.history = history_;
    result.fields = fields(body);
    result.snapshots = snapshots_;
    if (!snapshots_.empty() && snapshots_.back().time_us < result.fields.time_us)
        result.snapshots.push_back(result.fields);
    d.stop_time_us = stop_time * 1e6;
    d.largest_temperature_K = largest_temperature_;
    d.peak_strain_rate_per_s = peak_contact_rate_;
    d.plastic_work_J = balance.plastic_work;
    d.sliding_distance_mm = sliding_distance_ * 1e3;
    const impact::Fields& f = result.fields;
    d.smallest_grain_um =
        *std::min_element(f.grain_diameter_um.begin(), f.grain_diameter_um.end());
    d.largest_weakened_fraction =
        *std::max_element(f.weakened_fraction.begin(), f.weakened_fraction.end());
    d.largest_plastic_strain = *std::max_element(f.equivalent_plastic_strain.begin(),
                                                 f.equivalent_plastic_strain.end());
    for (std::size_t i = 0; i < history_.size(); ++i) {
        if (history_[i].time_us <= d.stop_time_us / 2) {
            d.mean_von_mises_GPa = mean_von_mises_[i] / 1e9;
        }
    }
    d.viscous_share = balance.viscous / balance.initial_kinetic;
    d.hourglass_share = balance.hourglass / balance.initial_kinetic;
    d.energy_error =
        std::abs(kinetic_energy(body) + balance.internal + balance.hourglass +
                 balance.contact - balance.initial_kinetic) /
        balance.initial_kinetic;
    result.steps = body.steps;
    result.neighbours = 4;
    result.phase_shares = body.clock.shares();
    result.points = static_cast<std::int64_t>(body.cells());
    result.grains_per_point = body.numerics.grains_per_point;
    result.grain_updates = body.cell_updates * body.numerics.grains_per_point;
}

}  // namespace taylorcal::axisymmetric
