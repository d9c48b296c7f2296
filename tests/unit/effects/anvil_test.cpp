#include "solver/sph/anvil.hpp"

#include "solver/axisymmetric/body.hpp"
#include "solver/axisymmetric/dynamics.hpp"
#include "tests/unit/effects/cases.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace taylorcal;
using impact::Geometry;
using testing::with_effect;

namespace {

/// A cylinder that stands at rest on the anvil, pressed to it while its foot slides
/// outwards at 10 m/s, in (r, z).
struct StandingRings {
    explicit StandingRings(const impact::ImpactCase& impact_case) : body(impact_case) {
        for (std::size_t n = 0; n < body.nodes(); ++n) {
            body.axial_velocity[n] = 0;
            body.axial_impulse[n] = -body.node_mass[n] * push;
            if (body.mesh.node_radius[n] > 0) body.radial_velocity[n] = 10;
        }
        axisymmetric::accelerate(body, step);
    }
    static constexpr double push = 2;  // velocity that the impulse would give [m/s]
    static constexpr double step = 1e-8;
    axisymmetric::Body body;
};

/// One step of particles that slide along the anvil and are pressed to it.
struct SlidingParticles {
    explicit SlidingParticles(const impact::ImpactCase& impact_case)
        : packing(sph::pack(impact_case.shape, 1e-3)),
          particles(packing.slots),
          anvil(packing, 8930, impact_case.additions) {
        particles.position = {packing.x, packing.y, packing.z};
        for (std::size_t slot = 0; slot < packing.slots; ++slot) {
            particles.velocity[1][slot] = 10;
            particles.velocity[2][slot] = -2;
        }
        for (const std::size_t block : packing.active) anvil.stop(particles, block, 1e-8);
    }
    sph::Packing packing;
    sph::Particles particles;
    sph::Anvil anvil;
};

}  // namespace

TEST_CASE("friction slows a sliding foot by mu times the normal impulse", "[effects]") {
    const StandingRings rings(
        with_effect("anvil_friction", 0.3, testing::short_bar(Geometry::axisymmetric)));
    const axisymmetric::Body& body = rings.body;
    double lost = 0;
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        const double radial =
            body.mesh.node_radius[n] == 0 ? 0 : (body.height[n] == 0 ? 10 - 0.3 * 2 : 10);
        CHECK(body.radial_velocity[n] == Approx(radial));
        if (radial > 0) lost += body.node_mass[n] * (100 - radial * radial) / 2;
    }
    // The anvil's own impulse ends no motion here, so that all work is friction's.
    CHECK(body.balance.contact == Approx(lost));
}

TEST_CASE("friction stops, and does not turn, what slides slowly", "[effects]") {
    impact::ImpactCase rough =
        with_effect("anvil_friction", 0.5, testing::short_bar(Geometry::axisymmetric));
    rough.additions.friction_coefficient = 50;
    const StandingRings rings(rough);
    for (const std::size_t n : rings.body.mesh.foot)
        CHECK(rings.body.radial_velocity[n] == 0);
}

TEST_CASE("friction slows sliding particles alike", "[effects]") {
    const SlidingParticles sliding(with_effect(
        "anvil_friction", 0.3, testing::short_bar(Geometry::three_dimensional)));
    double lost = 0;
    for (std::size_t slot = 0; slot < sliding.packing.slots; ++slot) {
        if (sliding.packing.volume[slot] <= 0) continue;
        const bool touches = sliding.packing.z[slot] == 0;
        const double mass = 8930 * sliding.packing.volume[slot];
        CHECK(sliding.particles.velocity[1][slot] == Approx(touches ? 9.4 : 10));
        CHECK(sliding.particles.velocity[2][slot] == (touches ? 0 : -2));
        if (touches) lost += mass * (4 + 100 - 9.4 * 9.4) / 2;
    }
    CHECK(sliding.anvil.lost_energy() == Approx(lost));
}

TEST_CASE("the face recedes at p/(rho c)", "[effects]") {
    constexpr double impedance = 7850 * 5900;
    const StandingRings rings(
        with_effect("elastic_anvil", 1, testing::short_bar(Geometry::axisymmetric)));
    const axisymmetric::Body& body = rings.body;
    double force = 0, yielded = 0;
    for (const std::size_t n : body.mesh.foot) {
        const double impulse = body.node_mass[n] * (body.axial_velocity[n] + 2);
        force += impulse / StandingRings::step;
        // The foot's nodes carry the rings between them, the rim half of the flank's too.
        yielded += -body.axial_velocity[n] / static_cast<double>(body.mesh.foot.size());
        CHECK(body.axial_velocity[n] * StandingRings::step ==
              Approx(-body.anvil.recession(n)));
    }
    const double area = std::numbers::pi * 4e-3 * 4e-3;
    CHECK(yielded == Approx(force / area / impedance).epsilon(0.15));

    const SlidingParticles pressed(
        with_effect("elastic_anvil", 1, testing::short_bar(Geometry::three_dimensional)));
    const double particle_force = pressed.anvil.impulse() / 1e-8;
    for (std::size_t slot = 0; slot < pressed.packing.slots; ++slot) {
        if (pressed.packing.volume[slot] <= 0 || pressed.packing.z[slot] > 0) continue;
        CHECK(-pressed.particles.velocity[2][slot] ==
              Approx(particle_force / area / impedance).epsilon(0.02));
        CHECK(pressed.anvil.recession(slot) ==
              Approx(-1e-8 * pressed.particles.velocity[2][slot]));
    }
}

TEST_CASE("a tilted anvil is met at one side of the rim", "[effects]") {
    const impact::ImpactCase tilted =
        with_effect("oblique_impact", 2, testing::short_bar(Geometry::three_dimensional));
    const SlidingParticles meeting(tilted);
    std::size_t touched = 0;
    for (std::size_t slot = 0; slot < meeting.packing.slots; ++slot) {
        if (meeting.packing.volume[slot] <= 0) continue;
        if (meeting.particles.velocity[2][slot] == -2) continue;
        ++touched;
        CHECK(meeting.packing.x[slot] < -3e-3);
        CHECK(meeting.packing.z[slot] == 0);
        // Pushed along the normal.
        const double kick = meeting.particles.velocity[2][slot] + 2;
        CHECK(meeting.particles.velocity[0][slot] ==
              Approx(kick * std::tan(2 * std::numbers::pi / 180)));
    }
    CHECK(touched > 0);
}
