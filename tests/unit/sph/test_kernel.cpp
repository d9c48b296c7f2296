#include "solver/sph/kernel.hpp"

#include <numbers>

#include <catch2/catch.hpp>

using taylorcal::sph::CubicSpline;

TEST_CASE("the kernel integrates to one", "[kernel]") {
    const double h = GENERATE(0.1, 1.0, 3.0);
    const CubicSpline kernel(h);
    constexpr int n = 20000;
    const double dr = kernel.support() / n;
    double integral = 0;
    for (int i = 0; i < n; ++i) {
        const double r = (i + 0.5) * dr;
        integral += 4 * std::numbers::pi * r * r * kernel.value(r) * dr;
    }
    CHECK(integral == Approx(1).epsilon(1e-7));
    CHECK(kernel.value(kernel.support()) == 0);
}

TEST_CASE("the kernel's gradient is its derivative", "[kernel]") {
    const double h = GENERATE(0.2, 1.7);
    const double q = GENERATE(0.3, 0.99, 1.01, 1.6, 1.99);
    const CubicSpline kernel(h);
    const double r = q * h, step = 1e-5 * h;
    const double slope = (kernel.value(r + step) - kernel.value(r - step)) / (2 * step);
    CHECK(-r * kernel.steepness(r) == Approx(slope).epsilon(1e-5));
}
