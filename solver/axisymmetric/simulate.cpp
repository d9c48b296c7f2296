#include "solver/impact/simulate.hpp"

#include "common/errors.hpp"
#include "solver/axisymmetric/cycle.hpp"
#include "solver/axisymmetric/monitor.hpp"
#include "solver/axisymmetric/profile.hpp"
#include "solver/impact/ringing_period.hpp"
#include "solver/impact/thread_clock.hpp"
#include "solver/observe/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <fmt/core.h>

namespace taylorcal::axisymmetric {
namespace {

constexpr int size_samples = 16;  // over one ringing period after the stop
constexpr std::int64_t cycles_between_clock_reads = 64;

/// Of the undeformed specimen [s].
double ringing_period(const Body& body, double length) {
    const double bulk = body.thermo.front().bulk_modulus;
    return impact::ringing_period(
        length, bulk, material::shear_modulus(bulk, body.parameters.poisson_ratio),
        body.parameters.initial_density);
}

/// Sizes and sampled outlines averaged over several moments.
class ShapeMean {
  public:
    void add(const observe::DeformedProfile& profile) {
        add_to(sizes_, observe::size_values(observe::measure(profile)));
        add_to(outline_, observe::sample_outline(profile));
        ++count_;
    }
    observe::Sizes sizes() const {
        const auto at = [&](std::size_t i) { return sizes_[i] / count_; };
        return {at(0), at(1), at(2), at(3), at(4), at(5), at(6)};
    }
    std::vector<double> outline() const {
        std::vector<double> mean = outline_;
        for (double& radius : mean) radius /= count_;
        return mean;
    }

  private:
    static void add_to(std::vector<double>& sum, const std::vector<double>& values) {
        sum.resize(values.size(), 0.0);
        for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
    }
    std::vector<double> sizes_;
    std::vector<double> outline_;
    int count_ = 0;
};

struct Ending {
    impact::Status status;
    std::string reason;
};

/// Why a run must end before its specimen has come to rest, or nothing.
std::optional<Ending> limit_reached(const Body& body, double cpu_s) {
    using impact::Status;
    const impact::Numerics& numerics = body.numerics;
    if (body.time > numerics.stop_time_limit_s) {
        return Ending{
            Status::not_stopped,
            fmt::format("the rear still moved after {:.0f} us", 1e6 * body.time)};
    }
    if (body.steps >= numerics.step_limit ||
        body.cell_updates >= numerics.point_update_limit) {
        return Ending{Status::not_stopped,
                      fmt::format("{} steps were not enough ({:.1f} us reached)",
                                  body.steps, 1e6 * body.time)};
    }
    if (cpu_s > numerics.cpu_limit_s) {
        return Ending{
            Status::over_cpu_limit,
            fmt::format("{:.0f} s of processor time were not enough ({:.1f} us reached)",
                        cpu_s, 1e6 * body.time)};
    }
    return std::nullopt;
}

void run(const impact::ImpactCase& impact_case, Body& body,
         impact::ImpactResult& result) {
    SelfContact self_contact(body);
    LocalSteps steps(body);
    Monitor monitor(body, impact_case);
    const bool fixed_time = impact_case.run_until_s > 0;
    const double end =
        fixed_time ? impact_case.run_until_s : std::numeric_limits<double>::infinity();
    const double begun = impact::thread_seconds();
    const double ringing = ringing_period(body, impact_case.shape.length());
    ShapeMean shape;
    int samples = 0;
    std::int64_t cycles = 0;
    double stop_time = std::numeric_limits<double>::quiet_NaN();
    while (result.reason.empty()) {
        result.reason =
            take_cycle(body, steps, self_contact, std::min(end, monitor.next_snapshot()));
        if (!result.reason.empty()) {
            result.status = impact::Status::failed;
            break;
        }
        monitor.observe(body);
        if (std::isnan(stop_time) && Monitor::rear_velocity(body) >= 0)
            stop_time = body.time;
        if (fixed_time) {
            if (body.time >= impact_case.run_until_s * (1 - 1e-9)) break;
        } else if (body.time >= stop_time + ringing * (samples + 0.5) / size_samples) {
            shape.add(deformed_profile(body, impact_case.shape));
            if (++samples == size_samples) break;
        }
        if (++cycles % cycles_between_clock_reads == 0) {
            const auto limit = limit_reached(body, impact::thread_seconds() - begun);
            if (!limit) continue;
            // A specimen that has stopped is measured, even when its ringing is cut
            // short, unless that depends on the machine.
            if (samples > 0 && limit->status == impact::Status::not_stopped) break;
            result.status = limit->status;
            result.reason = limit->reason;
        }
    }
    if (result.reason.empty()) result.status = impact::Status::stopped;
    result.profile = deformed_profile(body, impact_case.shape);
    if (samples == 0) shape.add(result.profile);
    result.sizes = shape.sizes();
    result.outline_radius = shape.outline();
    monitor.report(body, stop_time, result);
    result.cpu_s = impact::thread_seconds() - begun;
}

}  // namespace

impact::ImpactResult simulate(const impact::ImpactCase& impact_case) {
    const int grains = impact_case.numerics.grains_per_point;
    const int lanes = static_cast<int>(material::lane_count<float>);
    require(grains > 0 && (lanes % grains == 0 || grains % lanes == 0),
            fmt::format("grains_per_point = {} (expected a divisor or a multiple of {})",
                        grains, lanes));
    impact::ImpactResult result;
    Body body(impact_case);
    run(impact_case, body, result);
    return result;
}

}  // namespace taylorcal::axisymmetric
