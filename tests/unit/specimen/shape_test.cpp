#include "solver/specimen/shape.hpp"

#include "common/errors.hpp"

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
        const Shape shape = make_shape(shape_from_name(shape_names()[i]));
        CHECK_THAT(1e9 * volume(shape), WithinRel(expected[i], 1e-12));
        CHECK_THAT(shape.length(), WithinRel(40e-3, 1e-12));
        CHECK_THAT(shape.rear_radius(), WithinRel(4e-3, 1e-12));
    }
}

TEST_CASE("a shape scales with its diameter and length", "[specimen]") {
    for (const std::string& name : shape_names()) {
        const Shape shape = make_shape(shape_from_name(name));
        const Shape scaled = make_shape(shape_from_name(name), 16e-3, 120e-3);
        CHECK_THAT(volume(scaled), WithinRel(2 * 2 * 3 * volume(shape), 1e-12));
        CHECK_THAT(scaled.head_length, WithinRel(3 * shape.head_length, 1e-12));
        CHECK_THAT(scaled.radius_at(9e-3), WithinRel(2 * shape.radius_at(3e-3), 1e-12));
    }
}

TEST_CASE("the radius at a step is the one above it", "[specimen]") {
    const Shape shape = make_shape(ShapeKind::reduced_head_3mm);
    CHECK_THAT(shape.radius_at(0), WithinRel(1.5e-3, 1e-12));
    CHECK_THAT(shape.radius_at(9.999e-3), WithinRel(1.5e-3, 1e-12));
    CHECK_THAT(shape.radius_at(10e-3), WithinRel(4e-3, 1e-12));
    CHECK_THAT(shape.radius_at(40e-3), WithinRel(4e-3, 1e-12));
    CHECK_THAT(shape.head_length, WithinRel(10e-3, 1e-12));
}

TEST_CASE("a cone opens linearly", "[specimen]") {
    const Shape shape = make_shape(ShapeKind::truncated_cone);
    CHECK_THAT(shape.radius_at(5e-3), WithinRel(1.75e-3, 1e-12));
    CHECK_THAT(shape.radius_at(20e-3), WithinRel(4e-3, 1e-12));
    CHECK_THAT(shape.head_length, WithinRel(20e-3, 1e-12));
}

TEST_CASE("shape names are understood, or the nearest is named", "[specimen]") {
    for (const std::string& name : shape_names())
        CHECK(shape_name(shape_from_name(name)) == name);
    CHECK(shape_from_name("cone") == ShapeKind::truncated_cone);
    CHECK(shape_from_name("cylinder") == ShapeKind::uniform_cylinder);
    CHECK_THROWS_WITH(shape_from_name("reduced_head_5mm"), Contains("did you mean"));
    CHECK_THROWS_AS(shape_from_name("sphere"), InputError);
}

TEST_CASE("a specimen without extent is refused", "[specimen]") {
    CHECK_THROWS_AS(make_shape(ShapeKind::truncated_cone, -8e-3, 40e-3), InputError);
    CHECK_THROWS_AS(make_shape(ShapeKind::truncated_cone, 8e-3, 0), InputError);
}
