#include "solver/sph/run.hpp"

#include "solver/impact/ringing_period.hpp"
#include "solver/impact/simulate.hpp"
#include "solver/impact/thread_clock.hpp"
#include "solver/observe/outline.hpp"
#include "solver/sph/monitor.hpp"

#include <cmath>
#include <optional>

#include <fmt/core.h>

namespace taylorcal::sph {

namespace {

constexpr int samples_per_ringing_period = 20;
// A run's time scales with its length; 40 mm ring and stop within some 130 us.
constexpr double expected_duration_per_length = 130e-6 / 40e-3;  // [s/m]

/// The mean of several outlines of one specimen, point by point.
class ProfileMean {
  public:
    void add(const observe::DeformedProfile& profile) {
        if (count_++ == 0) {
            sum_ = profile;
            return;
        }
        for (std::size_t i = 0; i < profile.outline_height.size(); ++i) {
            sum_.outline_height[i] += profile.outline_height[i];
            sum_.outline_radius[i] += profile.outline_radius[i];
        }
        sum_.total_length += profile.total_length;
        sum_.transition_height += profile.transition_height;
        sum_.transition_radius += profile.transition_radius;
    }
    observe::DeformedProfile mean() const {
        observe::DeformedProfile mean = sum_;
        for (double& height : mean.outline_height) height /= count_;
        for (double& radius : mean.outline_radius) radius /= count_;
        mean.total_length /= count_;
        mean.transition_height /= count_;
        mean.transition_radius /= count_;
        return mean;
    }
    bool empty() const { return count_ == 0; }

  private:
    observe::DeformedProfile sum_;
    int count_ = 0;
};

/// One run from the first touch to the end of its last measurement.
class Run {
  public:
    Run(const impact::ImpactCase& impact_case, const StrengthFactory& make_strength)
        : case_(impact_case),
          body_(impact_case, make_strength),
          monitor_(impact_case, body_) {
        const double duration = case_.run_until_s > 0
                                    ? case_.run_until_s
                                    : expected_duration_per_length * case_.shape.length();
        record_interval_ = duration / case_.history_samples;
    }

    impact::ImpactResult compute() {
        impact::ImpactResult result;
        monitor_.record();
        if (case_.snapshot_interval_s > 0) take_snapshot();
        while (!finished(result)) advance();
        monitor_.record();
        if (profiles_.empty())
            profiles_.add(monitor_.outline().measure(body_.particles()));
        result.profile = profiles_.mean();
        result.sizes = observe::measure(result.profile);
        result.outline_radius = observe::sample_outline(result.profile);
        result.descriptors = monitor_.descriptors(stop_time_);
        result.history = monitor_.history();
        result.fields = monitor_.fields();
        result.snapshots = snapshots_;
        if (!snapshots_.empty() && snapshots_.back().time_us < result.fields.time_us)
            result.snapshots.push_back(result.fields);
        result.steps = body_.ticks();
        result.points = static_cast<std::int64_t>(body_.packing().particles);
        result.grain_updates = body_.point_updates() * case_.numerics.grains_per_point;
        result.grains_per_point = case_.numerics.grains_per_point;
        result.phase_shares = body_.clock().shares();
        result.neighbours = body_.mean_neighbours();
        result.cpu_s = impact::thread_seconds() - start_;
        return result;
    }

  private:
    void advance() {
        if (case_.run_until_s > 0) body_.shorten_cycle(case_.run_until_s - body_.time());
        body_.shorten_cycle(next_snapshot_ - body_.time());
        body_.cycle();
        const double velocity = monitor_.rear_velocity();
        if (!stop_time_ && velocity >= 0) {
            stop_time_ = body_.time();
            ringing_period_ = ringing_period();
        }
        if (body_.time() >= next_record_) {
            monitor_.record();
            next_record_ = body_.time() + record_interval_;
        }
        if (body_.time() >= next_snapshot_ * (1 - 1e-9)) take_snapshot();
        if (stop_time_ && case_.run_until_s <= 0 && body_.time() >= next_profile_) {
            profiles_.add(monitor_.outline().measure(body_.particles()));
            next_profile_ = body_.time() + ringing_period_ / samples_per_ringing_period;
        }
    }

    void take_snapshot() {
        snapshots_.push_back(monitor_.fields());
        const auto taken = static_cast<double>(snapshots_.size());
        next_snapshot_ = taken * case_.snapshot_interval_s;
    }

    /// Decides whether the run is over, and how it went.
    bool finished(impact::ImpactResult& result) const {
        using impact::Status;
        const auto end = [&](Status status, const std::string& reason) {
            result.status = status;
            result.reason = reason;
            return true;
        };
        if (body_.tangled()) {
            return end(Status::failed,
                       fmt::format("tangled particles at {:.4g} us", body_.time() * 1e6));
        }
        if (case_.run_until_s > 0) {
            if (body_.time() >= case_.run_until_s * (1 - 1e-9))
                return end(Status::stopped, "");
        } else if (stop_time_ && body_.time() >= *stop_time_ + ringing_period_) {
            return end(Status::stopped, "");
        }
        // A specimen that has stopped is measured, even when its ringing is cut short,
        // unless that depends on the machine.
        const Status status = stop_time_ ? Status::stopped : Status::not_stopped;
        const auto limit = [&](const std::string& what, double value) {
            return end(status, stop_time_
                                   ? ""
                                   : fmt::format("{} of {:g} reached while the rear "
                                                 "moves at {:.3g} m/s",
                                                 what, value, monitor_.rear_velocity()));
        };
        const impact::Numerics& numerics = case_.numerics;
        if (body_.time() >= numerics.stop_time_limit_s) {
            return limit("stop_time_limit_s", numerics.stop_time_limit_s);
        }
        if (body_.ticks() >= numerics.step_limit) {
            return limit("step_limit", static_cast<double>(numerics.step_limit));
        }
        if (body_.point_updates() >= numerics.point_update_limit) {
            return limit("point_update_limit",
                         static_cast<double>(numerics.point_update_limit));
        }
        if (impact::thread_seconds() - start_ > numerics.cpu_limit_s) {
            return end(Status::over_cpu_limit,
                       fmt::format("cpu_limit_s of {:g} reached at {:.4g} us",
                                   numerics.cpu_limit_s, body_.time() * 1e6));
        }
        return false;
    }

    double ringing_period() const {
        const std::size_t slot = body_.packing().active.back() * block_size;
        const double bulk =
            static_cast<double>(body_.particles().bulk_modulus.lanes()[slot]);
        return impact::ringing_period(
            case_.shape.length(), bulk, body_.shear_modulus(slot),
            static_cast<double>(body_.particles().density.lanes()[slot]));
    }

    const impact::ImpactCase& case_;
    double start_ = impact::thread_seconds();
    Body body_;
    Monitor monitor_;
    ProfileMean profiles_;
    double record_interval_ = 0;
    double next_record_ = 0;
    double next_profile_ = 0;
    double next_snapshot_ = INFINITY;
    std::vector<impact::Fields> snapshots_;
    double ringing_period_ = 0;
    std::optional<double> stop_time_;
};

}  // namespace

impact::ImpactResult run(const impact::ImpactCase& impact_case,
                         const StrengthFactory& make_strength) {
    return Run(impact_case, make_strength).compute();
}

impact::ImpactResult simulate(const impact::ImpactCase& impact_case) {
    return run(impact_case, material::make_strength<float>);
}

}  // namespace taylorcal::sph
