#include "solver/material/grain_orientations.hpp"
#include "solver/sph/orientations.hpp"
#include "tests/unit/effects/cases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace taylorcal;
using testing::with_effect;

namespace {

/// Shares of grains with a <111> and with a <100> axis along z.
std::pair<double, double> fibres(const std::vector<Eigen::Quaterniond>& grains) {
    double with_111 = 0, with_100 = 0;
    for (const Eigen::Quaterniond& grain : grains) {
        const Eigen::Vector3d z = grain.conjugate() * Eigen::Vector3d::UnitZ();
        with_111 += z.cwiseAbs().minCoeff() > 0.577;
        with_100 += z.cwiseAbs().maxCoeff() > 0.9999;
    }
    const auto count = static_cast<double>(grains.size());
    return {with_111 / count, with_100 / count};
}

}  // namespace

TEST_CASE("the textured share has its fibres along the axis", "[effects]") {
    const auto& changes = with_effect("rod_texture", 0.5).additions.orientations;
    const auto grains = material::grain_orientations(1000, 8, 3, changes);
    const auto [with_111, with_100] = fibres(grains);
    CHECK(with_111 == Approx(0.3).margin(0.02));
    CHECK(with_100 == Approx(0.2).margin(0.02));
    // The other half is as it was, and turns about the axis are uniform.
    const auto random = material::grain_orientations(1000, 8, 3);
    double unchanged = 0;
    Eigen::Vector3d side = Eigen::Vector3d::Zero();
    for (std::size_t g = 0; g < grains.size(); ++g) {
        unchanged += grains[g].coeffs() == random[g].coeffs();
        side += grains[g] * Eigen::Vector3d::UnitX() / static_cast<double>(grains.size());
    }
    CHECK(unchanged / static_cast<double>(grains.size()) == Approx(0.5).margin(0.01));
    CHECK(std::hypot(side.x(), side.y()) < 0.05);
    // Each point has its share.
    for (std::size_t point = 0; point < 1000; point += 97) {
        const auto first = grains.begin() + static_cast<long>(8 * point);
        const auto [a, b] = fibres({first, first + 8});
        CHECK(a + b == Approx(0.5).margin(0.13));
    }
}

TEST_CASE("particles keep their fourfold symmetry in a texture", "[effects]") {
    const auto& changes = with_effect("rod_texture", 1).additions.orientations;
    const auto bar = specimen::make_shape(specimen::uniform_cylinder);
    const auto grains = sph::random_orientations(5, sph::pack(bar, 1e-3), 1, changes);
    const auto [with_111, with_100] = fibres(grains);
    CHECK(with_111 == Approx(0.6).margin(0.04));
    CHECK(with_111 + with_100 == Approx(1));
}

TEST_CASE("the skin is 10^kappa denser at the surface and decays over 0.2 mm",
          "[effects]") {
    impact::ImpactCase head;
    head.shape = specimen::make_shape(specimen::reduced_head_4mm);
    const auto& skin = with_effect("hard_skin", 2, head).additions.initial_density;
    REQUIRE(skin.size() == 1);
    CHECK(skin[0](4e-3, 25e-3) == Approx(100));
    CHECK(skin[0](3.8e-3, 25e-3) == Approx(std::pow(10, 2 * std::exp(-1.0))));
    CHECK(skin[0](0, 25e-3) == Approx(1).epsilon(1e-6));
    CHECK(skin[0](2e-3, 5e-3) == Approx(100));   // flank of the head
    CHECK(skin[0](0, 0) == Approx(100));         // impact face
    CHECK(skin[0](3e-3, 10e-3) == Approx(100));  // shoulder
    CHECK(skin[0](1e-3, 11.5e-3) < 1.01);        // inside, above the head
}
