#include "common/specimen_names.hpp"
#include "solver/observe/sizes.hpp"
#include "solver/sph/outline.hpp"
#include "solver/sph/packing.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

specimen::Shape shape_of(int kind) {
    return specimen::make_shape(specimen::profile_named(paper_shapes().at(kind)), 8e-3,
                                40e-3);
}

/// Volume of the profile below a height, by many thin discs.
double volume_below(const specimen::Shape& shape, double height) {
    constexpr int n = 40000;
    double volume = 0;
    for (int i = 0; i < n; ++i) {
        const double r = shape.radius_at((i + 0.5) * height / n);
        volume += std::numbers::pi * r * r * height / n;
    }
    return volume;
}

double mean_radius_of_lowest_layer(const sph::Packing& packing) {
    const std::vector<std::size_t> slots = packing.slots_by_layer().front();
    double sum = 0, volume = 0;
    for (const std::size_t slot : slots) {
        sum += packing.volume[slot] * std::hypot(packing.x[slot], packing.y[slot]);
        volume += packing.volume[slot];
    }
    return sum / volume;
}

}  // namespace

TEST_CASE("particles have the mass of the profile, in total and by slice", "[packing]") {
    const specimen::Shape shape = shape_of(GENERATE(0, 1, 2, 3));
    const double edge = GENERATE(0.6e-3, 1e-3, 1.3e-3);
    const sph::Packing packing = sph::pack(shape, edge);
    double total = 0;
    for (const double volume : packing.volume) total += volume;
    CHECK(total == Approx(volume_below(shape, shape.length())).epsilon(1e-5));
    for (const double share : {0.1, 0.25, 0.4, 0.5, 0.8}) {
        double height = 0, below = 0;  // of the first layer that ends above the share
        for (const sph::Layer& layer : packing.layers) {
            if (layer.low >= share * shape.length()) break;
            height = layer.high;
        }
        for (std::size_t slot = 0; slot < packing.slots; ++slot) {
            if (packing.z[slot] < height) below += packing.volume[slot];
        }
        CHECK(below == Approx(volume_below(shape, height)).epsilon(1e-4));
    }
}

TEST_CASE("particles are balanced about the axis and none is a sliver", "[packing]") {
    const specimen::Shape shape = shape_of(GENERATE(0, 1, 2, 3));
    const sph::Packing packing = sph::pack(shape, 1e-3);
    double x = 0, y = 0, total = 0;
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        x += packing.volume[slot] * packing.x[slot];
        y += packing.volume[slot] * packing.y[slot];
        total += packing.volume[slot];
        if (packing.volume[slot] <= 0) continue;
        ++count;
        const double lattice_volume = std::pow(packing.local_edge[slot], 3) / 2;
        CHECK(packing.volume[slot] > 0.1 * lattice_volume);
        CHECK(packing.volume[slot] < 2.5 * lattice_volume);
    }
    CHECK(count == packing.particles);
    CHECK(std::abs(x) < 1e-12 * total);
    CHECK(std::abs(y) < 1e-12 * total);
}

TEST_CASE("thin sections have more than half as many particles across as the rear",
          "[packing]") {
    const specimen::Shape shape = shape_of(GENERATE(0, 1, 2, 3));
    const sph::Packing packing = sph::pack(shape, 4e-3 / 6);
    double before = packing.layers.front().edge;
    for (const sph::Layer& layer : packing.layers) {
        CHECK(layer.radius / layer.edge > 3.4);
        CHECK(layer.edge <= packing.edge);
        CHECK(layer.edge < 1.1 * before);
        CHECK(layer.edge >= before);
        before = layer.edge;
        if (layer.low > 0 && layer.high < shape.length())
            CHECK(layer.high - layer.low == Approx(layer.edge / 2).epsilon(0.04));
    }
    CHECK(packing.layers.back().edge == packing.edge);
}

TEST_CASE("the lattice widens nearly as fast as a cone", "[packing]") {
    const sph::Packing packing = sph::pack(shape_of(3), 4e-3 / 6);
    const sph::Layer& tip = packing.layers.front();
    // By the power 3/4 of the radius, until the rear's edge is reached.
    for (const sph::Layer& layer : packing.layers) {
        if (layer.edge == packing.edge) break;
        CHECK(layer.radius / layer.edge ==
              Approx(tip.radius / tip.edge * std::pow(layer.radius / tip.radius, 0.25))
                  .epsilon(0.02));
    }
}

TEST_CASE("the undeformed specimen measures its own dimensions", "[outline]") {
    const int kind = GENERATE(0, 1, 2, 3);
    const double edge = GENERATE(0.7e-3, 1e-3);
    const specimen::Shape shape = shape_of(kind);
    const sph::Packing packing = sph::pack(shape, edge);
    sph::Particles particles(packing.slots);
    particles.position = {packing.x, packing.y, packing.z};
    const observe::DeformedProfile profile =
        sph::Outline(shape, packing).measure(particles);
    CHECK(profile.total_length == Approx(40e-3).epsilon(1e-9));
    CHECK(profile.transition_height == Approx(shape.head_length).epsilon(1e-9));
    // The head's side of the section.
    const double transition[4] = {4e-3, 2e-3, 1.5e-3, 4e-3};
    CHECK(profile.transition_radius == Approx(transition[kind]).epsilon(1e-9));
    const double foot[4] = {4e-3, 2e-3, 1.5e-3, 1e-3};
    CHECK(profile.outline_radius.front() == Approx(foot[kind]).epsilon(1e-9));
    CHECK(profile.outline_height.front() == Approx(0).margin(1e-12));
    for (std::size_t i = 0; i < profile.outline_height.size(); ++i) {
        const double height = profile.outline_height[i];
        const bool at_step = std::abs(height - shape.head_length) < 1e-9;
        if (at_step) continue;
        CHECK(profile.outline_radius[i] == Approx(shape.radius_at(height)).epsilon(1e-6));
    }
}

TEST_CASE("the head-rear section is the head's, held by the rear", "[outline]") {
    const specimen::Shape shape = specimen::make_shape(specimen::reduced_head_4mm);
    const sph::Packing packing = sph::pack(shape, 0.7e-3);
    sph::Particles particles(packing.slots);
    particles.position = {packing.x, packing.y, packing.z};
    const sph::Outline outline(shape, packing);
    const double radius = shape.station_radius.front();
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        // The shoulder bends up, and the corner's particles are sheared outwards.
        if (std::hypot(packing.x[slot], packing.y[slot]) > radius + packing.edge)
            particles.position[2][slot] += 0.1e-3;
        particles.deformation[0][slot] = particles.deformation[4][slot] = 1.5;
    }
    const observe::DeformedProfile profile = outline.measure(particles);
    CHECK(profile.transition_height == Approx(shape.head_length).epsilon(1e-9));
    CHECK(profile.transition_radius == Approx(radius).epsilon(1e-9));
}

TEST_CASE("the section's height is its mean over the area, wherever the lattice has it",
          "[outline]") {
    const specimen::Shape shape = specimen::make_shape(specimen::reduced_head_4mm);
    const double edge = GENERATE(0.36e-3, 0.44e-3, 0.5e-3, 0.67e-3);
    const sph::Packing packing = sph::pack(shape, edge);
    sph::Particles particles(packing.slots);
    particles.position = {packing.x, packing.y, packing.z};
    // As steep as at the corner of a head that has folded; each particle's deformation
    // follows the height around it.
    constexpr double slope = -1;
    const double radius = shape.station_radius.front();
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        const double r = std::hypot(packing.x[slot], packing.y[slot]);
        if (packing.volume[slot] <= 0 || r == 0) continue;
        particles.position[2][slot] += slope * r;
        particles.deformation[6][slot] = slope * packing.x[slot] / r;
        particles.deformation[7][slot] = slope * packing.y[slot] / r;
    }
    const sph::Outline outline(shape, packing);
    const double face = slope * mean_radius_of_lowest_layer(packing);
    const double risen = outline.measure(particles).transition_height + face;
    CHECK(risen - shape.head_length == Approx(slope * radius * 2 / 3).epsilon(0.02));
}
