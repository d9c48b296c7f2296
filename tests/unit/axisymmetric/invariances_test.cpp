#include "solver/axisymmetric/cycle.hpp"
#include "solver/axisymmetric/profile.hpp"
#include "solver/material/grain_orientations.hpp"
#include "solver/observe/sizes.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

using Turn = std::function<Eigen::Quaterniond(std::size_t grain)>;

impact::ImpactCase short_case() {
    impact::ImpactCase impact_case;
    impact_case.shape = specimen::make_shape(specimen::reduced_head_4mm);
    impact_case.velocity_m_s = 90;
    impact_case.numerics.elements_across_radius = 6;
    impact_case.numerics.grains_per_point = 8;
    impact_case.numerics.cfl = 0.7;
    impact_case.numerics.hourglass = 0.1;
    impact_case.numerics.linear_viscosity = 0.04;
    return impact_case;
}

/// Sizes [mm] and plastic work [J] early in an impact, every grain turned in its cell's
/// frame (r, theta, z).
std::vector<double> shoot(std::uint64_t seed, const Turn& turn) {
    const impact::ImpactCase impact_case = short_case();
    axisymmetric::Body body(impact_case);
    const auto grains = static_cast<std::size_t>(impact_case.numerics.grains_per_point);
    auto orientations = material::grain_orientations(body.cells(), grains, seed);
    for (std::size_t g = 0; g < orientations.size(); ++g) {
        orientations[g] = turn(g) * orientations[g];
    }
    body.strength =
        material::make_strength<float>(impact_case.material, std::move(orientations));
    axisymmetric::LocalSteps steps(body);
    axisymmetric::SelfContact contact(body);
    while (body.time < 20e-6)
        REQUIRE(axisymmetric::take_cycle(body, steps, contact, 1).empty());
    auto answer = observe::size_values(
        observe::measure(axisymmetric::deformed_profile(body, impact_case.shape)));
    answer.push_back(body.balance.plastic_work);
    return answer;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i] / b[i] - 1));
    }
    return largest;
}

Eigen::Quaterniond about(double angle, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

}  // namespace

// What a grain answers splits into a part that has the mirror plane theta -> -theta and
// the shears r-theta and theta-z, which cells drop. So any grain may be exchanged for its
// mirror image, which for a lattice with a centre of symmetry is half a turn about theta.
TEST_CASE("mirror images of grains change nothing, whichever are mirrored") {
    const auto plain = shoot(1, [](std::size_t) { return about(0, {0, 1, 0}); });
    const auto mirrored = shoot(1, [](std::size_t grain) {
        return about(grain % 3 == 0 ? std::numbers::pi : 0, {0, 1, 0});
    });
    CHECK(difference(mirrored, plain) < 1e-5);
    // The other plane through the axis is none: it turns the shear r-z over.
    const auto turned = shoot(1, [](std::size_t grain) {
        return about(grain % 3 == 0 ? std::numbers::pi : 0, {0, 0, 1});
    });
    CHECK(difference(turned, plain) > 1e-4);
}

// A turn about the axis keeps the mean of S_rr and S_tt where the metal spreads alike in
// both, and not elsewhere: grains are a sample there, and the turned ones another.
TEST_CASE("grains turned about the axis are another sample of the same metal") {
    constexpr std::uint64_t seeds = 8;
    std::vector<double> plain, turned;
    double scatter = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const auto straight = shoot(seed, [](std::size_t) {
            return about(0, {0, 0, 1});
        });
        const auto answer = shoot(seed, [](std::size_t) {
            return about(0.7, {0, 0, 1});
        });
        plain.resize(straight.size());
        turned.resize(answer.size());
        for (std::size_t i = 0; i < plain.size(); ++i) {
            plain[i] += straight[i] / seeds;
            turned[i] += answer[i] / seeds;
        }
        scatter = std::max(scatter, difference(answer, straight));
    }
    CHECK(difference(turned, plain) < 0.01);
    CHECK(difference(turned, plain) < scatter / 2);
}
