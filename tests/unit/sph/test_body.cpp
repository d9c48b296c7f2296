#include "solver/material/elastic.hpp"
#include "solver/material/j2.hpp"
#include "solver/sph/body.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

impact::ImpactCase small_case() {
    impact::ImpactCase impact_case;
    impact_case.numerics.geometry = impact::Geometry::three_dimensional;
    impact_case.numerics.elements_across_radius = 4;
    impact_case.numerics.grains_per_point = 1;
    impact_case.material.equation_of_state = material::EquationOfStateModel::linear;
    return impact_case;
}

std::unique_ptr<material::Strength<float>> elastic(
    const material::Parameters& parameters,
    const std::vector<Eigen::Quaterniond>& orientations) {
    return material::make_elastic<float>(parameters, orientations.size());
}

std::unique_ptr<material::Strength<float>> plastic(
    const material::Parameters& parameters,
    const std::vector<Eigen::Quaterniond>& orientations) {
    return material::make_j2<float>(parameters, orientations.size());
}

/// Renewals of stresses over those with the finest step for all particles.
double share_of_updates(const sph::Body& body) {
    return static_cast<double>(body.point_updates()) /
           (static_cast<double>(body.ticks()) *
            static_cast<double>(body.packing().particles));
}

}  // namespace

TEST_CASE("an elastic bar rings with the bar wave speed, whatever its steps", "[body]") {
    const bool mixed = GENERATE(false, true);
    const impact::ImpactCase impact_case = small_case();
    sph::Body body(impact_case, elastic);
    const double length = impact_case.shape.length();
    if (mixed) {
        body.limit_steps(
            [&](const Eigen::Vector3d& x) { return x.z() < length / 4 ? 0.12 : 1; });
    }
    const double wave_number = std::numbers::pi / length;
    // The lowest longitudinal mode; the lower face moves off the anvil at first.
    body.set_velocity([&](const Eigen::Vector3d& x) {
        return Eigen::Vector3d(0, 0, 0.5 * std::cos(wave_number * x.z()) + 0.6);
    });
    const double initial = body.kinetic_energy();
    const auto amplitude = [&] {
        double sum = 0;
        for (std::size_t slot = 0; slot < body.packing().slots; ++slot) {
            sum += body.mass(slot) * (body.particles().velocity[2][slot] - 0.6) *
                   std::cos(wave_number * body.packing().z[slot]);
        }
        return sum;
    };
    // Four half periods: time enough for an instability to show.
    const double first = amplitude();
    double earlier = 0, crossing = 0, previous = first;
    int crossings = 0;
    while (crossings < 5 && body.time() < 100e-6) {
        const double before = body.time();
        body.cycle();
        REQUIRE_FALSE(body.tangled());
        const double now = amplitude();
        // Velocities live at mid step.
        const double middle = std::midpoint(before, body.time());
        if (now * previous < 0) {
            crossing = std::lerp(earlier, middle, previous / (previous - now));
            ++crossings;
        }
        previous = now;
        earlier = middle;
    }
    REQUIRE(crossings == 5);
    // Rayleigh's correction for the inertia of lateral motion: -(nu k r)^2/4.
    const double bulk = 138e9, poisson = 0.34;
    const double bar_speed = std::sqrt(3 * bulk * (1 - 2 * poisson) / 8930);
    const double k_r = poisson * wave_number * impact_case.shape.rear_radius();
    const double expected = bar_speed * (1 - k_r * k_r / 4);
    CHECK(2 * length / (4 * crossing / 9) == Approx(expected).epsilon(0.01));
    CHECK(body.total_energy() == Approx(initial).epsilon(2e-3));
    CHECK((share_of_updates(body) < 0.6) == mixed);
}

TEST_CASE("an impact keeps its energy, and its momentum along the anvil", "[body]") {
    impact::ImpactCase impact_case = small_case();
    impact_case.shape = specimen::make_shape(specimen::reduced_head_3mm);
    impact_case.velocity_m_s = 120;
    sph::Body body(impact_case, plastic);
    const double initial = body.kinetic_energy();
    const double stopping = [&] {
        double mass = 0;
        for (std::size_t slot = 0; slot < body.packing().slots; ++slot) {
            mass += body.mass(slot);
        }
        return mass * 120;
    }();
    while (body.time() < 30e-6) {
        body.cycle();
        REQUIRE_FALSE(body.tangled());
    }
    CHECK(body.kinetic_energy() < 0.9 * initial);
    CHECK(share_of_updates(body) < 0.5);
    CHECK(body.total_energy() == Approx(initial).epsilon(5e-3));
    double momentum[3] = {};
    for (std::size_t slot = 0; slot < body.packing().slots; ++slot) {
        for (std::size_t c = 0; c < 3; ++c) {
            momentum[c] += body.mass(slot) * body.particles().velocity[c][slot];
        }
    }
    CHECK(std::abs(momentum[0]) < 1e-6 * stopping);
    CHECK(std::abs(momentum[1]) < 1e-6 * stopping);
    CHECK(momentum[2] + stopping == Approx(body.anvil().impulse()).epsilon(1e-5));
    // The anvil only pushes, and nothing is below it.
    CHECK(body.anvil().impulse() > 0);
    for (std::size_t slot = 0; slot < body.packing().slots; ++slot) {
        if (body.packing().volume[slot] <= 0) continue;
        CHECK(body.particles().position[2][slot] > -1e-12);
    }
}

TEST_CASE("every shape balances its energy with viscosity and hourglass work", "[body]") {
    for (const specimen::Profile& profile :
         {specimen::uniform_cylinder, specimen::reduced_head_4mm,
          specimen::reduced_head_3mm, specimen::truncated_cone}) {
        impact::ImpactCase impact_case = small_case();
        impact_case.shape = specimen::make_shape(profile);
        impact_case.velocity_m_s = 120;
        impact_case.material = {};
        sph::Body body(impact_case, material::make_strength<float>);
        const double initial = body.total_energy();
        while (body.time() < 30e-6) body.cycle();
        const double error = std::abs(body.total_energy() - initial);
        CAPTURE(profile.end_radius);
        CHECK(error < 5e-3 * initial);
        // Without them there would be no balance.
        CHECK(body.constitutive().work().viscous > 0.5 * error);
        CHECK(body.constitutive().work().hourglass > 3 * error);
    }
}
