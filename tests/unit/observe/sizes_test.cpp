#include "solver/observe/sizes.hpp"

#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

namespace {

using namespace taylorcal::observe;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

/// A profile of `points` outline points over r(z), lengths in mm.
DeformedProfile profile_of(const std::function<double(double)>& radius_mm,
                           double length_mm, int points) {
    DeformedProfile profile;
    for (int i = 0; i <= points; ++i) {
        const double height = length_mm * i / points;
        profile.outline_height.push_back(1e-3 * height);
        profile.outline_radius.push_back(1e-3 * radius_mm(height));
    }
    profile.total_length = 1e-3 * length_mm;
    profile.transition_height = 1e-3 * 8;
    profile.transition_radius = 1e-3 * radius_mm(8);
    profile.initial_length = 40e-3;
    profile.initial_rear_radius = 4e-3;
    return profile;
}

}  // namespace

TEST_CASE("a cylinder that kept its shape gives back its sizes", "[sizes]") {
    const Sizes sizes = measure(profile_of([](double) { return 4; }, 40, 17));
    CHECK_THAT(sizes.final_length_mm, WithinRel(40, 1e-12));
    CHECK_THAT(sizes.impact_diameter_mm, WithinRel(8, 1e-12));
    CHECK_THAT(sizes.head_length_mm, WithinRel(8, 1e-12));
    CHECK_THAT(sizes.rear_length_mm, WithinRel(32, 1e-12));
    CHECK_THAT(sizes.transition_diameter_mm, WithinRel(8, 1e-12));
    CHECK_THAT(sizes.undeformed_length_mm, WithinRel(40, 1e-12));
    CHECK_THAT(sizes.diameter_at_0p2L0_mm, WithinRel(8, 1e-12));
}

TEST_CASE("a cone is read between the outline's points", "[sizes]") {
    // Radius 1 mm at the tip, 4 mm from 20 mm on; points every 2.5 mm.
    const auto radius = [](double z) { return std::min(1 + 0.15 * z, 4.0); };
    const Sizes sizes = measure(profile_of(radius, 40, 16));
    CHECK_THAT(sizes.impact_diameter_mm, WithinRel(2 * radius(2), 1e-12));
    CHECK_THAT(sizes.diameter_at_0p2L0_mm, WithinRel(2 * radius(8), 1e-12));
    // 0.5 % of 4 mm is lost 0.02/0.15 mm below the rear part.
    CHECK_THAT(sizes.undeformed_length_mm, WithinRel(20 + 0.02 / 0.15, 1e-9));
}

TEST_CASE("a bulged foot follows its closed form", "[sizes]") {
    const double bulge = 0.4;
    const double decay_mm = 3;
    const auto radius = [&](double z) {
        return 4 * (1 + bulge * std::exp(-z / decay_mm));
    };
    const Sizes sizes = measure(profile_of(radius, 35, 400));
    CHECK_THAT(sizes.impact_diameter_mm, WithinRel(2 * radius(0), 1e-12));
    CHECK_THAT(sizes.diameter_at_0p2L0_mm, WithinRel(2 * radius(8), 1e-4));
    CHECK_THAT(sizes.undeformed_length_mm,
               WithinAbs(35 - decay_mm * std::log(bulge / 0.005), 0.002));
}

TEST_CASE("the foot is read within 2 mm of the anvil only", "[sizes]") {
    // A barrel whose belly is higher than the foot zone.
    const auto radius = [](double z) {
        return z < 10 ? 4 + 0.3 * z : 7 - 0.12 * (z - 10);
    };
    const Sizes sizes = measure(profile_of(radius, 35, 70));
    CHECK_THAT(sizes.impact_diameter_mm, WithinRel(2 * radius(2), 1e-12));
}

TEST_CASE("the shoulder of the rear that sinks to the anvil is not the foot", "[sizes]") {
    DeformedProfile profile = profile_of([](double) { return 4; }, 40, 1);
    profile.outline_radius = {3.4e-3, 3e-3, 1.5e-3, 4e-3, 4e-3};
    profile.head_points = 3;
    const double shoulder = GENERATE(1.9e-3, 2.1e-3);
    profile.outline_height = {0, 0.5e-3, shoulder, shoulder, 32e-3};
    CHECK_THAT(measure(profile).impact_diameter_mm, WithinRel(6.8, 1e-12));
}

TEST_CASE("a step keeps the rear whole", "[sizes]") {
    DeformedProfile profile = profile_of([](double) { return 4; }, 40, 1);
    profile.outline_height = {0, 9e-3, 9e-3, 38e-3};
    profile.outline_radius = {3e-3, 2.2e-3, 4e-3, 4e-3};
    profile.total_length = 38e-3;
    CHECK_THAT(measure(profile).undeformed_length_mm, WithinRel(29, 1e-9));
}

TEST_CASE("a folded outline is read as its silhouette", "[sizes]") {
    DeformedProfile profile = profile_of([](double) { return 4; }, 40, 1);
    // The lip turns back towards the anvil: three radii at 0.4 mm.
    profile.outline_height = {0, 0.5e-3, 0.2e-3, 1e-3, 10e-3, 30e-3};
    profile.outline_radius = {5e-3, 6e-3, 7e-3, 4.5e-3, 4e-3, 4e-3};
    profile.total_length = 30e-3;
    profile.initial_length = 2e-3;  // 0.2 L0 is 0.4 mm
    const Sizes sizes = measure(profile);
    CHECK_THAT(sizes.impact_diameter_mm, WithinRel(14, 1e-12));
    CHECK_THAT(sizes.diameter_at_0p2L0_mm, WithinRel(2 * (7 - 2.5 * 0.25), 1e-9));
    // 4.02 mm is crossed 0.02/0.5 of the way from 10 mm down to 1 mm.
    CHECK_THAT(sizes.undeformed_length_mm, WithinRel(20 + 9 * 0.04, 1e-9));
}

TEST_CASE("one stray point does not end the undeformed part", "[sizes]") {
    DeformedProfile profile =
        profile_of([](double z) { return z < 15 ? 4 + 0.05 * (15 - z) : 4; }, 36, 72);
    const double clean = measure(profile).undeformed_length_mm;
    CHECK_THAT(clean, WithinRel(21 + 0.4, 1e-9));
    profile.outline_radius[55] *= 1.02;
    profile.outline_radius[64] *= 0.98;
    CHECK_THAT(measure(profile).undeformed_length_mm, WithinRel(clean, 1e-9));
}

TEST_CASE("a rear that swelled has no undeformed part", "[sizes]") {
    const Sizes sizes = measure(profile_of([](double) { return 4.1; }, 40, 10));
    CHECK(sizes.undeformed_length_mm == 0);
}

TEST_CASE("what cannot be read is NaN", "[sizes]") {
    // Flattened below 0.2 L0.
    const Sizes flat = measure(profile_of([](double) { return 9; }, 6, 10));
    CHECK(std::isnan(flat.diameter_at_0p2L0_mm));
    CHECK_THAT(flat.final_length_mm, WithinRel(6, 1e-12));
    for (const double value : size_values(measure(DeformedProfile{})))
        CHECK(std::isnan(value));
}

TEST_CASE("names and values of the sizes agree in number", "[sizes]") {
    CHECK(size_names().size() == size_values(measure(DeformedProfile{})).size());
}
