#include "solver/observe/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

namespace {

using namespace taylorcal::observe;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

/// An outline through points (height, radius) in mm of a rod of 4 mm radius and 20 mm.
DeformedProfile outline_through(const std::vector<std::array<double, 2>>& points) {
    DeformedProfile profile;
    for (const auto& [height, radius] : points) {
        profile.outline_height.push_back(1e-3 * height);
        profile.outline_radius.push_back(1e-3 * radius);
    }
    profile.total_length = 20e-3;
    profile.initial_length = 30e-3;
    profile.initial_rear_radius = 4e-3;
    return profile;
}

}  // namespace

TEST_CASE("the fractions rise within (0, 1) and are dense near the foot", "[outline]") {
    const auto& fractions = outline_fractions();
    CHECK(fractions.front() > 0);
    CHECK(fractions.back() < 1);
    CHECK(std::is_sorted(fractions.begin(), fractions.end()));
    const double first_gap = fractions[1] - fractions[0];
    const double last_gap = fractions[39] - fractions[38];
    CHECK(first_gap < last_gap / 3);
}

TEST_CASE("a cylinder has its own radius everywhere", "[outline]") {
    for (const double radius : sample_outline(outline_through({{0, 5}, {20, 5}})))
        CHECK_THAT(radius, WithinRel(1.25, 1e-12));
}

TEST_CASE("a cone is read between its points", "[outline]") {
    const std::vector<double> radii = sample_outline(
        outline_through({{0, 8}, {3, 7.4}, {11, 5.8}, {20, 4}}));  // 8 - z/5 mm
    for (std::size_t i = 0; i < outline_points; ++i)
        CHECK_THAT(radii[i], WithinRel((8 - 4 * outline_fractions()[i]) / 4, 1e-12));
}

TEST_CASE("a folded foot is read at its largest radius", "[outline]") {
    // The flange rolls out to 9 mm and back inwards below itself, to 6 mm, before it
    // rises.
    const DeformedProfile folded =
        outline_through({{0, 7}, {1, 9}, {1.5, 8.5}, {0.5, 6}, {4, 5}, {20, 4}});
    const std::vector<double> radii = sample_outline(folded);
    for (std::size_t i = 0; i < outline_points; ++i) {
        const double height = 20 * outline_fractions()[i];
        if (height <= 1)
            CHECK_THAT(radii[i], WithinRel((7 + 2 * height) / 4, 1e-12));
        else if (height < 1.5)
            CHECK_THAT(radii[i], WithinRel((9 - (height - 1)) / 4, 1e-12));
        else if (height < 4)
            CHECK_THAT(radii[i], WithinRel((6 - (height - 0.5) / 3.5) / 4, 1e-12));
    }
}

TEST_CASE("beyond the ends of the outline its end counts", "[outline]") {
    // The rim of the foot has curled up by 0.5 mm and that of the rear hangs down by 1
    // mm.
    const std::vector<double> radii =
        sample_outline(outline_through({{0.5, 6}, {19, 4}}));
    CHECK_THAT(radii.front(), WithinRel(1.5, 1e-12));
    CHECK_THAT(radii.back(), WithinRel(1.0, 1e-12));
}

TEST_CASE("without an outline all radii are NaN", "[outline]") {
    DeformedProfile lost = outline_through({{0, 5}, {20, 5}});
    SECTION("no points") { lost.outline_height.clear(); }
    SECTION("no length") { lost.total_length = std::nan(""); }
    const std::vector<double> radii = sample_outline(lost);
    REQUIRE(radii.size() == outline_points);
    for (const double radius : radii) CHECK(std::isnan(radius));
}
