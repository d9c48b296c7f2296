#include "solver/axisymmetric/grain_step.hpp"

#include <catch2/catch.hpp>

using taylorcal::axisymmetric::GrainStep;

namespace {

constexpr double shear_modulus = 48e9;
constexpr double time_step = 1e-9;
// Axial compression with a little shear, at constant volume [1/s].
constexpr GrainStep::Gradient squeeze = {1e4, 1e4, -2e4, 3e3, 1e3};

GrainStep::Gradient times(double factor, GrainStep::Gradient gradient) {
    for (double& component : gradient) component *= factor;
    return gradient;
}

/// The change of the deviator if all strain is elastic.
GrainStep::Deviator elastic(const GrainStep::Gradient& l, double time) {
    const double twice = 2 * shear_modulus * time;
    return {twice * l[0], twice * l[1], twice * l[2], twice * (l[3] + l[4]) / 2};
}

/// Moves the grains after one step at `l` that ends at `deviator`.
void move(GrainStep& grains, const GrainStep::Gradient& l,
          const GrainStep::Deviator& deviator) {
    grains.take(l, time_step);
    grains.finish(deviator, shear_modulus, true);
}

}  // namespace

TEST_CASE("grains move first, and then once a step would take them too far") {
    GrainStep grains;
    CHECK(grains.take(squeeze, time_step));
    grains.finish({}, shear_modulus, false);
    // |L| = 2.47e4/s: 4e-4 is reached after 16.2 steps.
    int steps = 1;
    while (!grains.take(squeeze, time_step)) ++steps;
    CHECK(steps == 16);
    CHECK(grains.time() == Approx(16e-9));
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(grains.mean_gradient()[i] == Approx(squeeze[i]));
}

TEST_CASE("soft metal that flows bears a tenth of its elastic strain") {
    GrainStep grains;
    // |S| = 1.2e7 Pa, an elastic strain of 1.28e-4; a step strains by 2.5e-6.
    move(grains, squeeze, {5e6, 5e6, -1e7, 0});
    int steps = 1;
    while (!grains.take(times(0.1, squeeze), time_step)) ++steps;
    CHECK(steps == 12);  // to 3e-5, the least, and not to 1.28e-5
    GrainStep harder;
    move(harder, squeeze, {5e7, 5e7, -1e8, 0});
    steps = 1;
    while (!harder.take(times(0.1, squeeze), time_step)) ++steps;
    CHECK(steps == 51);  // to 1.28e-4
}

TEST_CASE("a rigid rotation moves the grains as a strain does") {
    GrainStep grains;
    move(grains, {}, {4e8, 0, -4e8, 0});
    CHECK_FALSE(grains.take({0, 0, 0, 1e5, -1e5}, 0.5e-9));
    CHECK(grains.take({0, 0, 0, 1e5, -1e5}, 1.5e-9));
}

TEST_CASE("an elastic cell stays elastic between moves") {
    GrainStep grains;
    const GrainStep::Deviator first = elastic(squeeze, time_step);
    move(grains, squeeze, first);
    GrainStep::Deviator deviator = first;
    grains.predict(times(-3, squeeze), time_step, deviator);
    for (std::size_t i = 0; i < 4; ++i) CHECK(deviator[i] == Approx(-2 * first[i]));
}

TEST_CASE("a cell that flows keeps its stress, however fast it flows") {
    GrainStep grains;
    const GrainStep::Deviator flow_stress = {1e8, 1e8, -2e8, 2e7};
    move(grains, squeeze, flow_stress);
    move(grains, squeeze, flow_stress);  // over which nothing changed
    for (const double faster : {0.3, 1.0, 2.5}) {
        GrainStep::Deviator deviator = flow_stress;
        grains.predict(times(faster, squeeze), time_step, deviator);
        for (std::size_t i = 0; i < 4; ++i) CHECK(deviator[i] == Approx(flow_stress[i]));
    }
}

TEST_CASE("what does no work on a flowing cell is elastic") {
    GrainStep grains;
    const GrainStep::Deviator flow_stress = {1e8, 1e8, -2e8, 0};
    move(grains, {1e4, 1e4, -2e4, 0, 0}, flow_stress);
    move(grains, {1e4, 1e4, -2e4, 0, 0}, flow_stress);
    GrainStep::Deviator deviator = flow_stress;
    const GrainStep::Gradient shear = {0, 0, 0, 2e3, 2e3};
    grains.predict(shear, time_step, deviator);
    CHECK(deviator[2] == Approx(flow_stress[2]));
    CHECK(deviator[3] == Approx(elastic(shear, time_step)[3]));
}
