#include "solver/material/mobility.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::material;

namespace {

/// The production step, repeated until it stands.
template <class Real>
Lanes<Real> root(Lanes<Real> zeta) {
    Lanes<Real> z = {};
    for (int i = 0; i < 200; ++i) z = drag_root_step(zeta, z, drag_steepness(z));
    return z;
}

}  // namespace

TEMPLATE_TEST_CASE("the drag balance v/(1 - v^2)^(3/2) = zeta holds", "", float, double) {
    const double tolerance = sizeof(TestType) == 4 ? 2e-6 : 1e-13;
    for (int exponent = -12; exponent <= 6; ++exponent) {
        const double zeta = 3 * std::pow(10.0, exponent);
        const Lanes<TestType> z = root<TestType>(broadcast(static_cast<TestType>(zeta)));
        // With z = v/sqrt(1 - v^2) the left side is z (1 + z^2).
        const double value = static_cast<double>(z[0]);
        CHECK(value * (1 + value * value) == Approx(zeta).epsilon(3 * tolerance));
        const double ratio = value * static_cast<double>(drag_contraction(z)[0]);
        CHECK(ratio <= 1);
        if (zeta < 1e3) {
            CHECK(ratio / std::pow(1 - ratio * ratio, 1.5) ==
                  Approx(zeta).epsilon(300 * tolerance * (1 + zeta)));
        }
        const double hyperbolic =
            2 / std::sqrt(3.0) * std::sinh(std::asinh(1.5 * std::sqrt(3.0) * zeta) / 3);
        CHECK(value == Approx(hyperbolic).epsilon(tolerance));
    }
}

TEST_CASE("from any start the second step is above the root and the rest fall to it") {
    const Lanes<double> zeta = broadcast(0.7);
    const double limit = root<double>(zeta)[0];
    for (const double start : {0.0, 0.01, 0.5, 5.0, 500.0}) {
        Lanes<double> z = broadcast(start);
        z = drag_root_step(zeta, z, drag_steepness(z));
        for (int i = 0; i < 20; ++i) {
            CHECK(z[0] >= limit * (1 - 1e-14));
            const Lanes<double> next = drag_root_step(zeta, z, drag_steepness(z));
            CHECK(next[0] <= z[0] * (1 + 1e-14));
            z = next;
        }
    }
}
