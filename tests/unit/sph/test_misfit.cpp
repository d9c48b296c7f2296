#include "solver/sph/misfit.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace taylorcal;
using Eigen::Vector3d;

namespace {

constexpr double edge = 2e-3;

/// The 26 nearest sites of a bcc lattice that lie within `kept`.
std::vector<sph::Neighbour> bcc_neighbours(
    const std::function<bool(const Vector3d&)>& kept) {
    std::vector<sph::Neighbour> neighbours;
    for (int x = -2; x <= 2; ++x) {
        for (int y = -2; y <= 2; ++y) {
            for (int z = -2; z <= 2; ++z) {
                const int squares = x * x + y * y + z * z;
                const bool site = (x - y) % 2 == 0 && (x - z) % 2 == 0;
                const Vector3d offset = edge / 2 * Vector3d(x, y, z);
                if (site && squares > 0 && squares <= 8 && kept(offset))
                    neighbours.push_back({offset, std::pow(edge, 3) / 2});
            }
        }
    }
    return neighbours;
}

double misfit(const std::vector<sph::Neighbour>& neighbours,
              const std::function<double(const Vector3d&)>& field) {
    const auto weights = sph::misfit_weights(neighbours, edge);
    double sum = 0;
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
        sum += weights[n] * (field(neighbours[n].offset) - field(Vector3d::Zero()));
    }
    return sum * edge * edge;
}

/// cos(k . x), with k in units of pi over half an edge.
auto wave(const Vector3d& k) {
    return [=](const Vector3d& x) {
        return std::cos(std::numbers::pi / (edge / 2) * k.dot(x));
    };
}

const auto everywhere = [](const Vector3d&) { return true; };

}  // namespace

TEST_CASE("quadratic motion has no misfit, inside and on a face", "[misfit]") {
    const auto quadratic = [](const Vector3d& x) {
        const Vector3d u = x / edge;
        return 2 * u(0) - u(1) + u(0) * u(0) - 2 * u(1) * u(2) + 1.5 * u(2) * u(2) +
               0.5 * u(0) * u(1);
    };
    const auto whole = bcc_neighbours(everywhere);
    REQUIRE(whole.size() == 26);
    CHECK(std::abs(misfit(whole, quadratic)) < 0.1);
    const auto face = bcc_neighbours([](const Vector3d& x) { return x(2) >= 0; });
    REQUIRE(face.size() == 17);
    CHECK(std::abs(misfit(face, quadratic)) < 0.1);
    // Against motion that no gradient sees, of the same size.
    CHECK(std::abs(misfit(whole, wave({1, 0, 0}))) > 4);
}

TEST_CASE("the misfit of waves falls faster than with the square of their length",
          "[misfit]") {
    const auto whole = bcc_neighbours(everywhere);
    const Vector3d k = Vector3d(0.08, 0.05, 0.02);
    const double ratio = misfit(whole, wave(2 * k)) / misfit(whole, wave(k));
    CHECK(ratio > 8);  // 4 at second order
}

TEST_CASE("every wave that no gradient sees has a misfit", "[misfit]") {
    // The corners of the lattice's Brillouin zone and the middles of its faces.
    const auto whole = bcc_neighbours(everywhere);
    const double strongest = std::abs(misfit(whole, wave({1, 0, 0})));
    CHECK(std::abs(misfit(whole, wave({0.5, 0.5, 0.5}))) > 0.4 * strongest);
    CHECK(std::abs(misfit(whole, wave({0.5, 0.5, 0}))) > 0.4 * strongest);
}

TEST_CASE("an edge with as many neighbours as conditions still has a misfit",
          "[misfit]") {
    const auto rim =
        bcc_neighbours([](const Vector3d& x) { return x(2) >= 0 && x(0) >= 0; });
    REQUIRE(rim.size() == 11);
    CHECK(std::abs(misfit(rim, wave({1, 0, 0}))) > 0.05);
}
