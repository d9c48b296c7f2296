#include "solver/plate/simulate_plate.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using Catch::Matchers::WithinRel;

namespace {

plate::PlateCase thin_plates(const std::string& strength, double velocity) {
    plate::PlateCase plate_case;
    plate_case.flyer_thickness = 1e-3;
    plate_case.target_thickness = 2e-3;
    plate_case.velocity = velocity;
    plate_case.cell = 20e-6;
    plate_case.duration = 1.1e-6;
    material::set_model(plate_case.material, "strength", strength);
    return plate_case;
}

/// When the free surface first reaches a velocity [s].
double arrival(const plate::PlateResult& result, double velocity) {
    const auto first = std::find_if(
        result.history.begin(), result.history.end(),
        [=](const plate::PlateRecord& r) { return r.free_surface_velocity >= velocity; });
    REQUIRE(first != result.history.end());
    return first->time;
}

const plate::PlateRecord& record_at(const plate::PlateResult& result, double time) {
    const auto first =
        std::find_if(result.history.begin(), result.history.end(),
                     [=](const plate::PlateRecord& r) { return r.time >= time; });
    REQUIRE(first != result.history.end());
    return *first;
}

double velocity_at(const plate::PlateResult& result, double time) {
    return record_at(result, time).free_surface_velocity;
}

}  // namespace

TEST_CASE("an elastic wave arrives with the longitudinal speed of sound", "[plate]") {
    plate::PlateCase plate_case = thin_plates("elastic", 1);
    material::set_model(plate_case.material, "equation_of_state", "linear");
    const plate::PlateResult result = simulate_plate(plate_case);
    const double bulk = plate_case.material.bulk_modulus;
    const double mu = plate_case.material.poisson_ratio;
    const double speed =
        std::sqrt(3 * bulk * (1 - mu) / (1 + mu) / plate_case.material.initial_density);
    CHECK_THAT(arrival(result, 0.5), WithinRel(2e-3 / speed, 0.01));
    // Equal metals share the velocity; the free surface doubles it.
    const double plateau_begins = 2e-3 / speed;
    CHECK_THAT(velocity_at(result, plateau_begins + 0.2e-6), WithinRel(1.0, 0.002));
    CHECK_THAT(record_at(result, plateau_begins / 2).interface_velocity,
               WithinRel(0.5, 0.002));
    // The flyer is unloaded from its rear, and the target with it.
    CHECK(std::abs(velocity_at(result, plateau_begins + 0.39e-6) - 1) < 0.02);
    CHECK(velocity_at(result, plateau_begins + 2e-3 / speed + 0.1e-6 - 1e-9) < 0.1);
    CHECK(result.energy_error < 5e-3);
}

TEST_CASE("a strong shock follows the Hugoniot of copper", "[plate]") {
    const double flyer = 2000;
    const plate::PlateResult result = simulate_plate(thin_plates("dislocation", flyer));
    const double shock = 3940 + 1.489 * flyer / 2;  // Us = 3.94 + 1.489 up km/s
    CHECK_THAT(arrival(result, flyer / 2), WithinRel(2e-3 / shock, 0.02));
    CHECK_THAT(velocity_at(result, 2e-3 / shock + 0.1e-6), WithinRel(flyer, 0.02));
    CHECK_THAT(result.largest_stress, WithinRel(8930 * shock * flyer / 2, 0.03));
    CHECK(result.energy_error < 5e-3);
}

TEST_CASE("hardened metal has the larger elastic precursor", "[plate]") {
    plate::PlateCase plate_case = thin_plates("dislocation", 150);
    plate_case.duration = 0.6e-6;
    const double early = 2e-3 / 4450.0;  // after the elastic wave, before the plastic one
    plate_case.material.rho_immobile_initial = 1e11;
    const double soft = velocity_at(simulate_plate(plate_case), early);
    plate_case.material.rho_immobile_initial = 6.3e12;
    const double hard = velocity_at(simulate_plate(plate_case), early);
    CHECK(soft > 1);
    CHECK(hard > 1.5 * soft);
}
