#include "solver/specimen/shape.hpp"

#include "common/errors.hpp"
#include "common/specimen_names.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace taylorcal;
using namespace taylorcal::specimen;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinRel;

/// Volume of the piecewise linear profile: a sum of frusta, pi/3 h (a^2 + a b + b^2).
double volume(const Shape& shape) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < shape.station_height.size(); ++i) {
        const double height = shape.station_height[i + 1] - shape.station_height[i];
        const double a = shape.station_radius[i];
        const double b = shape.station_radius[i + 1];
        sum += M_PI / 3 * height * (a * a + a * b + b * b);
    }
    return sum;
}

}  // namespace

TEST_CASE("the four shapes have the paper's volumes", "[specimen]") {
    // Cylinders pi r^2 h; a frustum from 1 to 4 mm over 20 mm. [mm3]
    const double rear = M_PI * 16 * 30;
    const std::vector<double> expected = {M_PI * 16 * 40, rear + M_PI * 4 * 10,
                                          rear + M_PI * 2.25 * 10,
                                          M_PI * 16 * 20 + M_PI / 3 * 20 * (1 + 4 + 16)};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const Shape shape = make_shape(profile_named(paper_shapes()[i]));
        CHECK_THAT(1e9 * volume(shape), WithinRel(expected[i], 1e-12));
        CHECK_THAT(shape.length(), WithinRel(40e-3, 1e-12));
        CHECK_THAT(shape.rear_radius(), WithinRel(4e-3, 1e-12));
    }
}

TEST_CASE("a shape scales with its diameter and length", "[specimen]") {
    for (const std::string& name : paper_shapes()) {
        const Shape shape = make_shape(profile_named(name));
        const Shape scaled = make_shape(profile_named(name), 16e-3, 120e-3);
        CHECK_THAT(volume(scaled), WithinRel(2 * 2 * 3 * volume(shape), 1e-12));
        CHECK_THAT(scaled.head_length, WithinRel(3 * shape.head_length, 1e-12));
        CHECK_THAT(scaled.radius_at(9e-3), WithinRel(2 * shape.radius_at(3e-3), 1e-12));
    }
}

TEST_CASE("the radius at a step is the one above it", "[specimen]") {
    const Shape shape = make_shape(reduced_head_3mm);
    CHECK_THAT(shape.radius_at(0), WithinRel(1.5e-3, 1e-12));
    CHECK_THAT(shape.radius_at(9.999e-3), WithinRel(1.5e-3, 1e-12));
    CHECK_THAT(shape.radius_at(10e-3), WithinRel(4e-3, 1e-12));
    CHECK_THAT(shape.radius_at(40e-3), WithinRel(4e-3, 1e-12));
    CHECK_THAT(shape.head_length, WithinRel(10e-3, 1e-12));
}

TEST_CASE("a cone opens linearly", "[specimen]") {
    const Shape shape = make_shape(truncated_cone);
    CHECK_THAT(shape.radius_at(5e-3), WithinRel(1.75e-3, 1e-12));
    CHECK_THAT(shape.radius_at(20e-3), WithinRel(4e-3, 1e-12));
    CHECK_THAT(shape.head_length, WithinRel(20e-3, 1e-12));
}

TEST_CASE("shape names are understood, or the nearest is named", "[specimen]") {
    CHECK(profile_named("cone") == truncated_cone);
    CHECK(full_name("cone") == "truncated_cone");
    CHECK(profile_named("cylinder") == uniform_cylinder);
    CHECK_THROWS_WITH(profile_named("reduced_had_3mm"), Contains("did you mean"));
    CHECK_THROWS_AS(profile_named("sphere"), InputError);
}

TEST_CASE("a name tells the measures of a specimen of one's own", "[specimen]") {
    const Profile head = profile_named("reduced_head_5mm_by_12mm");
    CHECK(head.kind == ProfileKind::stepped);
    const Shape shape = make_shape(head);
    CHECK_THAT(shape.radius_at(11.9e-3), WithinRel(2.5e-3, 1e-12));
    CHECK_THAT(shape.radius_at(12e-3), WithinRel(4e-3, 1e-12));
    CHECK_THAT(shape.head_length, WithinRel(12e-3, 1e-12));

    // As drawn, for a specimen that is not 8 mm x 40 mm.
    const Shape cone = make_shape(
        profile_named("truncated_cone_2.5mm_by_9mm_of_7.6mm_by_25.4mm"), 7.6e-3, 25.4e-3);
    CHECK_THAT(cone.radius_at(0), WithinRel(1.25e-3, 1e-12));
    CHECK_THAT(cone.radius_at(4.5e-3), WithinRel((1.25e-3 + 3.8e-3) / 2, 1e-12));
    CHECK_THAT(cone.head_length, WithinRel(9e-3, 1e-12));
}

TEST_CASE("the paper's shapes are instances of names with measures", "[specimen]") {
    CHECK(profile_named("reduced_head_4mm") == profile_named("reduced_head_4mm_by_10mm"));
    CHECK(profile_named("reduced_head_3mm") ==
          profile_named("reduced_head_3mm_of_8mm_by_40mm"));
    CHECK(profile_named("truncated_cone") == profile_named("truncated_cone_2mm"));
}

TEST_CASE("measures that no mesh can hold are refused with their name", "[specimen]") {
    CHECK_THROWS_WITH(profile_named("reduced_head_9mm"),
                      Contains("reduced_head_9mm") && Contains("diameter"));
    CHECK_THROWS_WITH(profile_named("truncated_cone_0.5mm"), Contains("0.15 to 0.9"));
    CHECK_THROWS_WITH(profile_named("reduced_head_5mm_by_39mm"), Contains("length"));
    CHECK_THROWS_WITH(profile_named("reduced_head_5mm_of_0mm_by_40mm"), Contains("0 mm"));
}

TEST_CASE("a specimen without extent is refused", "[specimen]") {
    CHECK_THROWS_AS(make_shape(truncated_cone, -8e-3, 40e-3), InputError);
    CHECK_THROWS_AS(make_shape(truncated_cone, 8e-3, 0), InputError);
}
