#include "solver/sph/reference.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

/// A bar of three blocks a column, the lowest of which needs eight times finer steps.
struct Bar {
    Bar() {
        for (const std::size_t block : packing.active) {
            stable.push_back(low(block) ? 1.01e-9 : 8.2e-9);
        }
        schedule.plan(stable);
        schedule.start({});
    }
    /// The next cycle, when the upper blocks bear steps of `longest` [s]; their step
    /// then.
    double upper_step(double longest) {
        for (std::size_t i = 0; i < stable.size(); ++i)
            if (!low(packing.active[i])) stable[i] = longest;
        schedule.plan(stable);
        schedule.start({});
        const auto last = static_cast<std::uint32_t>(stable.size() - 1);
        for (int level = 0;; ++level) {
            const auto& blocks = schedule.renewed(level);
            if (std::find(blocks.begin(), blocks.end(), last) != blocks.end())
                return schedule.step(level);
        }
    }
    bool low(std::size_t block) const {
        return packing.z[block * sph::block_size] < 10e-3;
    }

    sph::Packing packing =
        sph::pack(specimen::make_shape(specimen::uniform_cylinder, 8e-3, 40e-3), 1e-3);
    sph::Reference reference{packing, 8930};
    std::vector<std::vector<std::uint32_t>> stencils = reference.stencils(packing);
    sph::Schedule schedule{packing, stencils};
    std::vector<double> stable;
};

}  // namespace

TEST_CASE("blocks step as their stencils need, and meet at the cycle's end",
          "[schedule]") {
    Bar bar;
    REQUIRE(bar.schedule.ticks() == 8);
    for (std::size_t level = 0; level <= sph::Schedule::highest_level; ++level) {
        for (const std::uint32_t index : bar.schedule.renewed(static_cast<int>(level))) {
            CHECK(bar.schedule.step(static_cast<int>(level)) <= bar.stable[index]);
        }
    }
    std::vector<double> moved(bar.packing.active.size()), renewed(moved);
    for (std::uint32_t tick = 0; tick < bar.schedule.ticks(); ++tick) {
        for (int l = 0; l <= bar.schedule.open_level(tick); ++l) {
            for (const auto i : bar.schedule.moving(l)) moved[i] += bar.schedule.step(l);
        }
        for (int l = 0; l <= bar.schedule.open_level(tick + 1); ++l) {
            for (const auto i : bar.schedule.renewed(l)) {
                renewed[i] += bar.schedule.step(l);
                // Whatever the renewal reads has come as far as it has itself.
                for (const auto j : bar.stencils[i]) {
                    CHECK(moved[j] == Approx(renewed[i]));
                }
            }
        }
    }
    for (const double time : moved) CHECK(time == Approx(bar.schedule.duration()));
    for (const double time : renewed) CHECK(time == Approx(bar.schedule.duration()));
}

TEST_CASE("a step does not go to and fro where what is stable hardly changes",
          "[schedule]") {
    Bar bar;
    CHECK(bar.upper_step(8.2e-9) == Approx(8 * 1.01e-9));
    const double shorter = bar.upper_step(8.0e-9);
    CHECK(shorter <= 8.0e-9);
    for (int wave = 0; wave < 4; ++wave) {
        CHECK(bar.upper_step(8.2e-9) == Approx(shorter));
        CHECK(bar.upper_step(8.0e-9) == Approx(shorter));
    }
    CHECK(bar.upper_step(8.6e-9) == Approx(8 * 1.01e-9));
}

TEST_CASE("particles that may collide move together", "[schedule]") {
    Bar bar;
    const std::size_t foot = bar.packing.active.front() * sph::block_size;
    const std::size_t rear = bar.packing.active.back() * sph::block_size;
    CHECK(bar.schedule.motion_level(foot) == 0);
    CHECK(bar.schedule.motion_level(rear) == 3);
    bar.schedule.start({{foot, rear}});
    CHECK(bar.schedule.motion_level(rear) == 0);
    const auto last = static_cast<std::uint32_t>(bar.packing.active.size() - 1);
    const auto& soon = bar.schedule.renewed(1);
    CHECK(std::find(soon.begin(), soon.end(), last) != soon.end());
}

TEST_CASE("impulses of pairs add up to nothing over a cycle of mixed steps",
          "[schedule]") {
    Bar bar;
    sph::Particles particles(bar.packing.slots);
    for (const std::size_t block : bar.packing.active) {
        for (std::size_t c = 0; c < 9; ++c) {
            for (std::size_t k = 0; k < sph::block_size; ++k) {
                const double z = bar.packing.z[block * sph::block_size + k];
                particles.pull[c][block][k] =
                    static_cast<float>(std::sin(900 * z + static_cast<double>(c)));
            }
        }
    }
    // The second cycle has shorter steps, for some blocks by other factors.
    for (double& stable : bar.stable) stable *= stable < 2e-9 ? 0.9 : 0.45;
    bar.schedule.plan(bar.stable);
    bar.schedule.start({});
    double impulse = 0, scale = 0;
    for (std::uint32_t tick = 0; tick < bar.schedule.ticks(); ++tick) {
        for (int l = 0; l <= bar.schedule.open_level(tick); ++l) {
            for (const std::uint32_t i : bar.schedule.moving(l)) {
                const std::size_t block = bar.packing.active[i];
                if (bar.schedule.pulled_alike(i, tick)) {
                    bar.reference.accelerate(particles, block,
                                             bar.schedule.share(i, tick));
                } else {
                    bar.reference.accelerate(particles, block,
                                             bar.schedule.arrivals(i, tick));
                }
                for (std::size_t k = 0; k < sph::block_size; ++k) {
                    const double f =
                        bar.schedule.step(l) *
                        bar.packing.volume[block * sph::block_size + k] *
                        static_cast<double>(particles.acceleration[2][block][k]);
                    impulse += f;
                    scale += std::abs(f);
                }
            }
        }
    }
    CHECK(scale > 0);
    CHECK(std::abs(impulse) < 1e-6 * scale);
}
