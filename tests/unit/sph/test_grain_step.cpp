#include "solver/sph/grain_step.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;
using sph::Vector;

namespace {

constexpr float shear_modulus = 48e9f;
constexpr float time_step = 1e-9f;

/// Axial compression with a little shear, at constant volume [1/s], times `factor`.
struct Squeeze {
    explicit Squeeze(float factor = 1) {
        const float components[9] = {1e4f, 0, 3e3f, 0, 1e4f, 0, 1e3f, 0, -2e4f};
        for (int i = 0; i < 9; ++i) l[i] = Vector(factor * components[i]);
    }
    Vector l[9];
};

struct Deviator {
    Deviator(float xx, float yy, float zz, float xz)
        : s{Vector(xx), Vector(yy), Vector(zz), Vector{}, Vector(xz), Vector{}} {}
    Vector s[6];
};

/// The deviator if all strain is elastic.
Deviator elastic(float factor, float time) {
    const float twice = 2 * shear_modulus * time * factor;
    return {twice * 1e4f, twice * 1e4f, -twice * 2e4f, twice * 2e3f};
}

void move(sph::GrainStep& grains, float factor, const Deviator& deviator,
          float plastic_rate) {
    grains.take(Squeeze(factor).l, time_step);
    grains.finish(deviator.s, Vector{}, Vector(plastic_rate), Vector(shear_modulus));
}

double of_first(const Vector& v) { return static_cast<double>(v[0]); }

}  // namespace

TEST_CASE("the grains of a block move when one particle has been strained enough",
          "[grain_step]") {
    sph::GrainStep grains;
    CHECK(grains.take(Squeeze().l, time_step));
    grains.finish(Deviator(0, 0, 0, 0).s, Vector{}, Vector{}, Vector(shear_modulus));
    // |L| = 2.47e4/s in one lane: 4e-4 is reached after 16.2 steps.
    Squeeze one(0);
    for (int i = 0; i < 9; ++i) one.l[i][5] = Squeeze().l[i][5];
    int steps = 1;
    while (!grains.take(one.l, time_step)) ++steps;
    CHECK(steps == 16);
    CHECK(grains.time() == Approx(16e-9));
    Vector mean[9];
    grains.mean_gradient(mean);
    for (int i = 0; i < 9; ++i) {
        CHECK(mean[i][5] == Approx(one.l[i][5]));
        CHECK(mean[i][4] == 0);
    }
}

TEST_CASE("an elastic block stays elastic between moves", "[grain_step]") {
    sph::GrainStep grains;
    const Deviator first = elastic(1, time_step);
    move(grains, 1, first, 0);
    Deviator deviator = first;
    grains.predict(Squeeze(-3).l, time_step, deviator.s);
    for (int i = 0; i < 6; ++i)
        CHECK(of_first(deviator.s[i]) == Approx(-2 * of_first(first.s[i])).margin(1));
}

TEST_CASE("a block that flows keeps its stress, however fast it flows", "[grain_step]") {
    sph::GrainStep grains;
    const Deviator flow_stress(1e8f, 1e8f, -2e8f, 2e7f);
    move(grains, 1, flow_stress, 1e4f);
    move(grains, 1, flow_stress, 1e4f);  // over which nothing changed
    for (const float faster : {0.3f, 1.0f, 2.5f}) {
        Deviator deviator = flow_stress;
        grains.predict(Squeeze(faster).l, time_step, deviator.s);
        for (int i = 0; i < 6; ++i)
            CHECK(of_first(deviator.s[i]) ==
                  Approx(of_first(flow_stress.s[i])).epsilon(1e-4).margin(1));
    }
}
