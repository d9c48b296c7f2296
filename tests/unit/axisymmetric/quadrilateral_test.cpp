#include "solver/axisymmetric/quadrilateral.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal::axisymmetric;

namespace {

const std::array<double, 4> r = {1.0, 2.3, 2.1, 0.7};
const std::array<double, 4> z = {0.1, -0.2, 1.4, 1.1};

/// Gauss points enough for the polynomials at hand: integral of f over the ring's
/// section.
template <class Function>
double integrate(const Function& f) {
    const std::array<double, 3> point = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
    const std::array<double, 3> weight = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    constexpr std::array<double, 4> xi = {-1, 1, 1, -1};
    constexpr std::array<double, 4> eta = {-1, -1, 1, 1};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            std::array<double, 4> shape{};
            double r_xi = 0, r_eta = 0, z_xi = 0, z_eta = 0, radius = 0;
            for (std::size_t a = 0; a < 4; ++a) {
                shape[a] = (1 + xi[a] * point[i]) * (1 + eta[a] * point[j]) / 4;
                radius += shape[a] * r[a];
                r_xi += xi[a] * (1 + eta[a] * point[j]) / 4 * r[a];
                r_eta += eta[a] * (1 + xi[a] * point[i]) / 4 * r[a];
                z_xi += xi[a] * (1 + eta[a] * point[j]) / 4 * z[a];
                z_eta += eta[a] * (1 + xi[a] * point[i]) / 4 * z[a];
            }
            sum +=
                weight[i] * weight[j] * (r_xi * z_eta - r_eta * z_xi) * f(shape, radius);
        }
    }
    return sum;
}

}  // namespace

TEST_CASE("volume, area and hoop integrals agree with Gauss quadrature") {
    const Ring ring = ring_of(r, z);
    const double two_pi = 2 * std::numbers::pi;
    CHECK(ring.area == Approx(integrate([](const auto&, double) { return 1.0; })));
    CHECK(ring.volume ==
          Approx(two_pi * integrate([](const auto&, double radius) { return radius; })));
    for (std::size_t a = 0; a < 4; ++a) {
        CHECK(ring.hoop[a] ==
              Approx(two_pi * integrate([&](const auto& n, double) { return n[a]; })));
    }
}

TEST_CASE("the gradients are the volume's derivatives") {
    const double step = 1e-6;
    const Ring ring = ring_of(r, z);
    for (std::size_t a = 0; a < 4; ++a) {
        auto up = r, down = r;
        up[a] += step;
        down[a] -= step;
        CHECK(ring.radial[a] + ring.hoop[a] ==
              Approx((ring_of(up, z).volume - ring_of(down, z).volume) / (2 * step)));
        up = down = z;
        up[a] += step;
        down[a] -= step;
        CHECK(ring.axial[a] ==
              Approx((ring_of(r, up).volume - ring_of(r, down).volume) / (2 * step)));
    }
}

TEST_CASE("a linear velocity field has its own gradient exactly") {
    const Ring ring = ring_of(r, z);
    double rr = 0, tt = 0, zz = 0, rz = 0, zr = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        const double vr = 3 * r[a];
        const double vz = 5 * z[a] - 2 * r[a];
        rr += ring.radial[a] * vr / ring.volume;
        tt += ring.hoop[a] * vr / ring.volume;
        zz += ring.axial[a] * vz / ring.volume;
        rz += ring.axial[a] * vr / ring.volume;
        zr += ring.radial[a] * vz / ring.volume;
    }
    CHECK(tt == Approx(3));
    CHECK(rr == Approx(3));
    CHECK(zz == Approx(5));
    CHECK(rz == Approx(0).margin(1e-12));
    CHECK(zr == Approx(-2));
}

TEST_CASE("a cell that tapers on the axis is narrower than its mean height") {
    const auto width = [](const std::array<double, 4>& r,
                          const std::array<double, 4>& z) {
        return narrowest_width(ring_of(r, z), r, z);
    };
    CHECK(width({0, 4, 4, 0}, {0, 0, 1, 1}) == Approx(1));
    // Mean height 1, at the axis 0.4.
    CHECK(width({0, 4, 4, 0}, {0, 0, 1.6, 0.4}) == Approx(0.55).epsilon(0.06));
    CHECK(width({2, 6, 6, 2}, {0, 0, 1.6, 0.4}) == Approx(1).epsilon(0.06));
}
