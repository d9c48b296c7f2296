#include "solver/sph/hourglass.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;
using sph::Vector;

namespace {

constexpr float rate = 4e6f;       // of the misfit in x [1/(m s)]
constexpr float stiffness = 2e4f;  // [Pa m2]
constexpr float step = 1e-8f;      // [s]
constexpr int steps = 500;

Vector everywhere(float value) { return Vector{} + value; }

struct Ended {
    double misfit;  ///< [1/m]
    double pull;    ///< [Pa m]
    double work;    ///< [J/m3]
};

/// A misfit that grows steadily for `steps`.
Ended strain(float relaxation) {
    sph::Particles particles(sph::block_size);
    particles.misfit_rate[0][0] = everywhere(rate);
    const sph::MisfitResistance<Vector> resistance = {everywhere(stiffness),
                                                      everywhere(relaxation)};
    double work = 0;
    for (int i = 0; i < steps; ++i) {
        const Vector power = sph::resist_misfit(particles, 0, resistance, step);
        work += static_cast<double>(power[3] * step);
    }
    CHECK(particles.misfit_pull[1][0][3] == 0);
    return {static_cast<double>(particles.elastic_misfit[0][0][3]),
            static_cast<double>(particles.misfit_pull[0][0][3]), work};
}

}  // namespace

TEST_CASE("elastic metal stores the work of its misfit", "[hourglass]") {
    const Ended ended = strain(0);
    const double misfit = static_cast<double>(rate) * steps * static_cast<double>(step);
    CHECK(ended.misfit == Approx(misfit).epsilon(1e-4));
    CHECK(ended.pull == Approx(static_cast<double>(stiffness) * misfit).epsilon(1e-4));
    CHECK(ended.work == Approx(ended.pull * misfit / 2).epsilon(1e-4));
}

TEST_CASE("metal that slips resists its misfit as a viscous one", "[hourglass]") {
    constexpr float relaxation = 2e7f;  // a time constant of five steps
    const Ended ended = strain(relaxation);
    CHECK(ended.misfit == Approx(static_cast<double>(rate / relaxation)).epsilon(1e-4));
    CHECK(ended.pull ==
          Approx(static_cast<double>(stiffness * rate / relaxation)).epsilon(1e-4));
}
