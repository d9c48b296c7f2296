#include "solver/sph/monitor.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::sph {

namespace {

constexpr double rear_share = 0.125;      // of the length, whose mean velocity is watched
constexpr double deformed_strain = 0.05;  // equivalent, of the deformed part
// The grains' states are slow to read, and their mean stress changes slowly.
constexpr std::size_t records_per_stress_sample = 10;

/// Visits (index within active, lane, slot) of every particle.
template <class Visit>
void for_particles(const Packing& packing, const Visit& visit) {
    for (std::size_t index = 0; index < packing.active.size(); ++index) {
        for (std::size_t lane = 0; lane < block_size; ++lane) {
            const std::size_t slot = packing.active[index] * block_size + lane;
            if (packing.volume[slot] > 0) visit(index, lane, slot);
        }
    }
}

/// Straight lines between samples (time, value), that of the last one after it.
double interpolated(const std::vector<std::pair<double, double>>& samples, double time) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const auto& [before, low] = samples[i - 1];
        const auto& [after, high] = samples[i];
        if (time <= after)
            return std::lerp(low, high, (time - before) / (after - before));
    }
    return samples.back().second;
}

}  // namespace

Monitor::Monitor(const impact::ImpactCase& impact_case, const Body& body)
    : body_(body),
      outline_(impact_case.shape, body.packing()),
      initial_kinetic_energy_(body.kinetic_energy()),
      spot_radius_(outline_.contact_spot_radius(body.particles())) {
    const double height = (1 - rear_share) * impact_case.shape.length();
    for_particles(body.packing(), [&](std::size_t, std::size_t, std::size_t slot) {
        if (body.packing().z[slot] > height) rear_.push_back(slot);
    });
}

double Monitor::rear_velocity() const {
    double momentum = 0, mass = 0;
    for (const std::size_t slot : rear_) {
        momentum += body_.mass(slot) * body_.particles().velocity[2][slot];
        mass += body_.mass(slot);
    }
    return momentum / mass;
}

double Monitor::von_mises(std::size_t slot) const {
    const auto s = [&](std::size_t c) {
        return static_cast<double>(body_.particles().stress_deviator[c].lanes()[slot]);
    };
    return std::sqrt(1.5 * (s(0) * s(0) + s(1) * s(1) + s(2) * s(2)) +
                     3 * (s(3) * s(3) + s(4) * s(4) + s(5) * s(5)));
}

double Monitor::largest_temperature() const {
    float largest = 0;
    for_particles(body_.packing(), [&](std::size_t, std::size_t, std::size_t slot) {
        largest = std::max(largest, body_.particles().temperature.lanes()[slot]);
    });
    return static_cast<double>(largest);
}

double Monitor::mean_von_mises_of_deformed_part() const {
    double sum = 0, volume = 0;
    for_particles(
        body_.packing(), [&](std::size_t index, std::size_t lane, std::size_t slot) {
            const double strain =
                body_.constitutive().state(index, lane).equivalent_plastic_strain;
            if (strain < deformed_strain) return;
            sum += body_.packing().volume[slot] * von_mises(slot);
            volume += body_.packing().volume[slot];
        });
    return volume > 0 ? sum / volume : 0;
}

double Monitor::sliding_distance() const {
    const Packing& packing = body_.packing();
    const double low = packing.layers[1].height;
    double longest = 0;
    for_particles(packing, [&](std::size_t, std::size_t, std::size_t slot) {
        if (packing.z[slot] > low) return;
        const double before = std::hypot(packing.x[slot], packing.y[slot]);
        const auto& position = body_.particles().position;
        const double now = std::hypot(position[0][slot], position[1][slot]);
        longest = std::max(longest, now - before);
    });
    return longest;
}

void Monitor::record() {
    const observe::DeformedProfile profile = outline_.measure(body_.particles());
    const double spot_radius = outline_.contact_spot_radius(body_.particles());
    const double elapsed = body_.time() - spot_time_;
    const double rate = elapsed > 0 ? std::log(spot_radius / spot_radius_) / elapsed : 0;
    spot_radius_ = spot_radius;
    spot_time_ = body_.time();
    const double temperature = largest_temperature();
    largest_temperature_ = std::max(largest_temperature_, temperature);
    if (history_.size() % records_per_stress_sample == 0) {
        von_mises_.emplace_back(body_.time(), mean_von_mises_of_deformed_part());
    }
    history_.push_back({body_.time() * 1e6, profile.total_length * 1e3,
                        observe::foot_radius(profile) * 1e3, rear_velocity(), rate,
                        temperature, body_.kinetic_energy(), body_.total_energy()});
}

impact::Descriptors Monitor::descriptors(std::optional<double> stop_time_s) const {
    impact::Descriptors d;
    d.largest_temperature_K = largest_temperature_;
    for (const impact::HistoryRecord& h : history_) {
        d.peak_strain_rate_per_s =
            std::max(d.peak_strain_rate_per_s, h.radial_strain_rate_per_s);
    }
    const Work& work = body_.constitutive().work();
    d.plastic_work_J = work.plastic;
    d.sliding_distance_mm = sliding_distance() * 1e3;
    d.smallest_grain_um = INFINITY;
    for_particles(body_.packing(), [&](std::size_t index, std::size_t lane, std::size_t) {
        const material::GrainState s = body_.constitutive().state(index, lane);
        d.smallest_grain_um = std::min(d.smallest_grain_um, s.grain_diameter_m * 1e6);
        d.largest_weakened_fraction =
            std::max(d.largest_weakened_fraction, s.weakened_fraction);
        d.largest_plastic_strain =
            std::max(d.largest_plastic_strain, s.equivalent_plastic_strain);
    });
    if (stop_time_s) {
        d.stop_time_us = *stop_time_s * 1e6;
        d.mean_von_mises_GPa = 1e-9 * interpolated(von_mises_, *stop_time_s / 2);
    }
    d.viscous_share = work.viscous / initial_kinetic_energy_;
    d.hourglass_share = work.hourglass / initial_kinetic_energy_;
    d.energy_error = std::abs(body_.total_energy() - initial_kinetic_energy_) /
                     initial_kinetic_energy_;
    return d;
}

impact::Fields Monitor::fields() const {
    impact::Fields f;
    f.time_us = body_.time() * 1e6;
    const Packing& packing = body_.packing();
    const Particles& p = body_.particles();
    for_particles(packing, [&](std::size_t index, std::size_t lane, std::size_t slot) {
        f.x_mm.push_back(p.position[0][slot] * 1e3);
        f.y_mm.push_back(p.position[1][slot] * 1e3);
        f.z_mm.push_back(p.position[2][slot] * 1e3);
        f.initial_x_mm.push_back(packing.x[slot] * 1e3);
        f.initial_y_mm.push_back(packing.y[slot] * 1e3);
        f.initial_z_mm.push_back(packing.z[slot] * 1e3);
        f.volume_mm3.push_back(body_.mass(slot) /
                               static_cast<double>(p.density.lanes()[slot]) * 1e9);
        f.temperature_K.push_back(static_cast<double>(p.temperature.lanes()[slot]));
        f.von_mises_GPa.push_back(von_mises(slot) * 1e-9);
        f.pressure_GPa.push_back(static_cast<double>(p.pressure.lanes()[slot]) * 1e-9);
        const material::GrainState s = body_.constitutive().state(index, lane);
        f.equivalent_plastic_strain.push_back(s.equivalent_plastic_strain);
        f.grain_diameter_um.push_back(s.grain_diameter_m * 1e6);
        f.weakened_fraction.push_back(s.weakened_fraction);
    });
    return f;
}

}  // namespace taylorcal::sph
