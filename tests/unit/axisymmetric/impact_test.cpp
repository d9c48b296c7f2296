#include "solver/axisymmetric/cycle.hpp"
#include "solver/axisymmetric/dynamics.hpp"
#include "solver/impact/simulate.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::axisymmetric;
using specimen::Profile;

namespace {

impact::ImpactCase small_case(const Profile& profile, double velocity) {
    impact::ImpactCase impact_case;
    impact_case.shape = specimen::make_shape(profile);
    impact_case.velocity_m_s = velocity;
    impact_case.numerics.elements_across_radius = 5;
    impact_case.numerics.grains_per_point = 8;
    impact_case.numerics.cfl = 0.7;
    impact_case.numerics.hourglass = 0.1;
    impact_case.numerics.linear_viscosity = 0.04;
    return impact_case;
}

double axial_momentum(const Body& body) {
    double sum = 0;
    for (std::size_t n = 0; n < body.nodes(); ++n)
        sum += body.node_mass[n] * body.axial_velocity[n];
    return sum;
}

}  // namespace

TEST_CASE("a run to the stop keeps its energy and shortens its specimen") {
    for (const Profile& profile :
         {specimen::uniform_cylinder, specimen::reduced_head_4mm}) {
        const auto result = axisymmetric::simulate(small_case(profile, 70));
        REQUIRE(result.status == impact::Status::stopped);
        CHECK(result.descriptors.energy_error < 2e-3);
        CHECK(result.descriptors.viscous_share < 0.02);
        CHECK(result.descriptors.hourglass_share < 0.04);
        CHECK(result.sizes.final_length_mm < 39.5);
        CHECK(result.sizes.final_length_mm > 33);
    }
}

TEST_CASE("metal too strong to yield bounces with the energy it had") {
    impact::ImpactCase impact_case = small_case(specimen::reduced_head_4mm, 150);
    impact_case.material.rho_immobile_initial = 1e15;
    impact_case.material.hardening_coefficient = 10;
    const auto result = axisymmetric::simulate(impact_case);
    REQUIRE(result.status == impact::Status::stopped);
    CHECK(result.descriptors.energy_error < 5e-3);
    CHECK(result.descriptors.viscous_share < 0.02);
    CHECK(result.history.back().rear_velocity_m_s > 75);
}

TEST_CASE("an elastic wave runs along a thin bar at sqrt(E/rho)") {
    impact::ImpactCase impact_case = small_case(specimen::uniform_cylinder, 0.5);
    impact_case.shape = specimen::make_shape(specimen::uniform_cylinder, 1e-3, 40e-3);
    impact_case.material.strength = material::StrengthModel::elastic;
    impact_case.material.equation_of_state = material::EquationOfStateModel::linear;
    Body body(impact_case);
    // Two gauges on the axis: where the front's middle has passed tells its speed.
    const auto gauge_at = [&](double target) {
        std::size_t nearest = 0;
        for (std::size_t n = 0; n < body.nodes(); ++n) {
            if (body.radius[n] == 0 && std::abs(body.height[n] - target) <
                                           std::abs(body.height[nearest] - target)) {
                nearest = n;
            }
        }
        return nearest;
    };
    const std::size_t gauges[] = {gauge_at(10e-3), gauge_at(30e-3)};
    double arrival[2] = {};
    double last[2] = {-0.25, -0.25};
    double last_time = 0;
    LocalSteps steps(body);
    SelfContact contact(body);
    while (arrival[1] == 0 && body.time < 19e-6) {
        REQUIRE(take_cycle(body, steps, contact, 20e-6).empty());
        for (int g = 0; g < 2; ++g) {
            const double now = body.axial_velocity[gauges[g]] + 0.25;
            if (arrival[g] == 0 && now > 0)
                arrival[g] = std::lerp(body.time, last_time, now / (now - last[g]));
            last[g] = now;
        }
        last_time = body.time;
    }
    const double distance =
        body.mesh.node_height[gauges[1]] - body.mesh.node_height[gauges[0]];
    const double shear = material::shear_modulus(138e9, 0.34);
    const double young = 2 * shear * 1.34;
    CHECK(distance / (arrival[1] - arrival[0]) ==
          Approx(std::sqrt(young / 8930)).epsilon(0.01));
}

TEST_CASE(
    "the anvil's impulse is the specimen's change of momentum, and it never pulls") {
    const impact::ImpactCase impact_case = small_case(specimen::uniform_cylinder, 60);
    Body body(impact_case);
    double before = axial_momentum(body);
    const LocalSteps steps(body);
    const double step = 20e-9;
    std::fill(body.cell_step.begin(), body.cell_step.end(), step);
    for (int i = 0; i < 500; ++i) {
        for (std::size_t c = 0; c < body.cells(); ++c) push_nodes(body, c, step);
        std::vector<double> free = body.axial_velocity;
        double internal = 0;
        for (std::size_t n = 0; n < body.nodes(); ++n) {
            free[n] += body.axial_impulse[n] / body.node_mass[n];
            internal += body.axial_impulse[n];
        }
        accelerate(body, step);
        double impulse = 0;
        for (std::size_t n = 0; n < body.nodes(); ++n) {
            const double given = body.node_mass[n] * (body.axial_velocity[n] - free[n]);
            CHECK(given >= 0);
            impulse += given;
        }
        const double after = axial_momentum(body);
        CHECK(std::abs(internal) < 1e-9 * std::abs(before));
        CHECK(after - before == Approx(impulse).margin(1e-9 * std::abs(before)));
        before = after;
        drift(body, step);
        for (const LocalSteps::Group& group : steps.groups())
            REQUIRE(update_cells(body, group.first, group.last).empty());
    }
}

TEST_CASE("cells with unequal steps keep momentum and energy in free flight") {
    Body body(small_case(specimen::truncated_cone, 0));
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        const double height = body.height[n] / 40e-3;
        body.axial_velocity[n] = 40 + 30 * height * height;
        body.radial_velocity[n] = -2e4 * (1 - height) * body.radius[n];
    }
    const double momentum = axial_momentum(body);
    const double energy = kinetic_energy(body);
    LocalSteps steps(body);
    SelfContact contact(body);
    int levels = 0;
    while (body.time < 9.999e-6) {
        REQUIRE(take_cycle(body, steps, contact, 10e-6).empty());
        for (const LocalSteps::Group& group : steps.groups())
            levels = std::max(levels, group.level);
    }
    CHECK(levels >= 2);
    CHECK(axial_momentum(body) == Approx(momentum).epsilon(1e-12));
    CHECK(body.balance.internal > 0.1 * energy);
    CHECK(kinetic_energy(body) + body.balance.internal + body.balance.hourglass +
              body.balance.contact ==
          Approx(energy).epsilon(5e-4));
}

TEST_CASE(
    "neighbours differ by one level at most, and touching cells step the shortest") {
    const Body body(small_case(specimen::truncated_cone, 100));
    LocalSteps steps(body);
    const std::size_t corner = body.mesh.rear.back();
    steps.assign(body, 1e-3, {corner});
    std::vector<int> lowest(body.nodes(), 99), highest(body.nodes(), 0);
    int deepest = 0;
    for (const LocalSteps::Group& group : steps.groups()) {
        deepest = std::max(deepest, group.level);
        for (std::size_t c = group.first; c < group.last; ++c) {
            for (const std::size_t n : body.mesh.cells[c]) {
                lowest[n] = std::min(lowest[n], group.level);
                highest[n] = std::max(highest[n], group.level);
            }
        }
    }
    CHECK(deepest >= 2);
    CHECK(highest[corner] == 0);
    for (std::size_t n = 0; n < body.nodes(); ++n) CHECK(highest[n] - lowest[n] <= 1);
}

TEST_CASE("outline nodes that meet give up their closing velocity, momentum kept") {
    impact::ImpactCase impact_case = small_case(specimen::reduced_head_4mm, 0);
    Body body(impact_case);
    SelfContact contact(body);
    // The shoulder's outer node is brought down onto the head's side.
    const auto& outline = body.mesh.outline;
    const std::size_t corner =
        outline[outline.size() - 1 -
                static_cast<std::size_t>(
                    std::count_if(outline.begin(), outline.end(), [&](std::size_t n) {
                        return body.mesh.node_height[n] > 10.001e-3;
                    }))];
    REQUIRE(body.mesh.node_radius[corner] == Approx(4e-3));
    body.radius[corner] = 2.01e-3;
    body.height[corner] = 4.7e-3;
    body.radial_velocity[corner] = -50;
    const double momentum = body.node_mass[corner] * -50;
    contact.apply(body, 1e-6);
    double after = 0;
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        after += body.node_mass[n] * body.radial_velocity[n];
    }
    CHECK(after == Approx(momentum));
    CHECK(body.radial_velocity[corner] > -50);
    CHECK(body.balance.contact > 0);
}

TEST_CASE("a shoulder's node beside the corner is kept out of the head") {
    Body body(small_case(specimen::reduced_head_4mm, 0));
    SelfContact contact(body);
    const auto& outline = body.mesh.outline;
    std::size_t corner = 0;
    while (body.height[outline[corner]] < 10e-3 - 1e-9) ++corner;
    const std::size_t below = outline[corner - 1], beside = outline[corner + 1];
    REQUIRE(body.radius[beside] > body.radius[outline[corner]]);
    body.radius[beside] = body.radius[below] - 1e-9;
    body.height[beside] = (body.height[below] + body.height[outline[corner]]) / 2;
    body.radial_velocity[beside] = -50;
    contact.apply(body, 1e-9);
    CHECK(body.radial_velocity[beside] > -49);
    CHECK(body.radial_velocity[beside] ==
          Approx((body.radial_velocity[below] + body.radial_velocity[outline[corner]]) /
                 2));
}

TEST_CASE("the 227 m/s copper bar at a coarse setting is near the published sizes") {
    impact::ImpactCase impact_case = small_case(specimen::uniform_cylinder, 227);
    impact_case.shape = specimen::make_shape(specimen::uniform_cylinder, 6.4e-3, 32.4e-3);
    impact_case.material.strength = material::StrengthModel::j2;
    impact_case.material.equation_of_state = material::EquationOfStateModel::linear;
    impact_case.material.poisson_ratio = 0.35;
    impact_case.material.bulk_modulus = 117e9 / 3 / (1 - 0.7);
    impact_case.run_until_s = 80e-6;
    const auto result = axisymmetric::simulate(impact_case);
    REQUIRE(result.status == impact::Status::stopped);
    CHECK(result.sizes.final_length_mm == Approx(21.45).epsilon(0.01));
    CHECK(result.sizes.impact_diameter_mm / 2 == Approx(7.2).epsilon(0.03));
}

TEST_CASE("a run that cannot end says so and keeps its sizes") {
    impact::ImpactCase impact_case = small_case(specimen::uniform_cylinder, 60);
    impact_case.numerics.stop_time_limit_s = 5e-6;
    const auto result = axisymmetric::simulate(impact_case);
    CHECK(result.status == impact::Status::not_stopped);
    CHECK(result.reason.find("still moved") != std::string::npos);
    CHECK(std::isfinite(result.sizes.final_length_mm));
}

TEST_CASE("a specimen that has stopped is measured though its ringing is cut short") {
    impact::ImpactCase impact_case = small_case(specimen::reduced_head_4mm, 90);
    const auto whole = axisymmetric::simulate(impact_case);
    impact_case.numerics.stop_time_limit_s = 1e-6 * (whole.descriptors.stop_time_us + 3);
    const auto cut = axisymmetric::simulate(impact_case);
    CHECK(cut.steps < whole.steps);
    CHECK(cut.status == impact::Status::stopped);
    CHECK(cut.reason.empty());
    CHECK(cut.sizes.final_length_mm == Approx(whole.sizes.final_length_mm).epsilon(2e-3));
}
