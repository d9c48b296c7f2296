#include "solver/axisymmetric/mesh.hpp"

#include "solver/axisymmetric/quadrilateral.hpp"

#include <numbers>
#include <utility>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::axisymmetric;
using specimen::Profile;

TEST_CASE("cells fill the profile: volume, outline and sections") {
    struct Expected {
        Profile profile;
        double volume_mm3;
    };
    constexpr double pi = std::numbers::pi;
    // Cylinders and a truncated cone, pi h (R^2 + R r + r^2)/3.
    const Expected expected[] = {
        {specimen::uniform_cylinder, pi * 16 * 40},
        {specimen::reduced_head_4mm, pi * (4 * 10 + 16 * 30)},
        {specimen::reduced_head_3mm, pi * (2.25 * 10 + 16 * 30)},
        {specimen::truncated_cone, pi * (20.0 / 3 * (16 + 4 + 1) + 16 * 20)}};
    for (const auto& [profile, volume_mm3] : expected) {
        for (const auto& [across, refined] :
             {std::pair(6, false), std::pair(8, true), std::pair(13, true)}) {
            const specimen::Shape shape = specimen::make_shape(profile);
            const Mesh mesh = make_mesh(shape, across, refined);
            double volume = 0;
            for (const auto& cell : mesh.cells) {
                std::array<double, 4> r{}, z{};
                for (std::size_t a = 0; a < 4; ++a) {
                    r[a] = mesh.node_radius[cell[a]];
                    z[a] = mesh.node_height[cell[a]];
                }
                const Ring ring = ring_of(r, z);
                CHECK(ring.area > 0);
                volume += ring.volume;
            }
            CHECK(volume * 1e9 == Approx(volume_mm3).epsilon(1e-12));
            CHECK(mesh.node_height[mesh.transition.front()] == Approx(shape.head_length));
            CHECK(mesh.node_height[mesh.outline.front()] == 0);
            CHECK(mesh.node_height[mesh.outline.back()] == Approx(40e-3));
            CHECK(mesh.node_radius[mesh.outline.back()] == Approx(4e-3));
            for (std::size_t i = 0; i + 1 < mesh.outline.size(); ++i) {
                CHECK(mesh.node_height[mesh.outline[i + 1]] >=
                      mesh.node_height[mesh.outline[i]]);
            }
        }
    }
}

TEST_CASE("refined meshes have more cells, or narrower ones at the rim") {
    const auto cut = [](const Profile& profile, bool refined) {
        return make_mesh(specimen::make_shape(profile), 8, refined);
    };
    for (const Profile& profile : {specimen::uniform_cylinder, specimen::reduced_head_4mm,
                                   specimen::truncated_cone})
        CHECK(cut(profile, true).cells.size() > cut(profile, false).cells.size());
    // Width of the foot's outermost column over the mean.
    const auto rim = [&](const Profile& profile, bool refined) {
        const Mesh mesh = cut(profile, refined);
        const auto radius = [&](std::size_t i) { return mesh.node_radius[mesh.foot[i]]; };
        const std::size_t columns = mesh.foot.size() - 1;
        return (radius(columns) - radius(columns - 1)) / radius(columns) *
               static_cast<double>(columns);
    };
    CHECK(rim(specimen::truncated_cone, false) == Approx(1));
    CHECK(rim(specimen::reduced_head_4mm, true) == Approx(1));
    CHECK(rim(specimen::reduced_head_3mm, false) == Approx(1));
    CHECK(rim(specimen::reduced_head_3mm, true) < 0.9);
    CHECK(rim(specimen::truncated_cone, true) == Approx(0.4));  // 0.25 + 0.75 / 5
}
