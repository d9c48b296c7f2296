#include "solver/impact/simulate.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

impact::ImpactCase coarse_case() {
    impact::ImpactCase impact_case;
    impact_case.numerics.geometry = impact::Geometry::three_dimensional;
    impact_case.numerics.elements_across_radius = 3;
    impact_case.numerics.grains_per_point = 1;
    return impact_case;
}

}  // namespace

// Published results of many codes: length 21.42 mm, radius 7.22 mm (Zienkiewicz et al.
// 1998, doi 10.1002/(SICI)1097-0207(19980615)42:3; Foulk et al. 2021 and others).
TEST_CASE("the 227 m/s copper bar", "[run]") {
    impact::ImpactCase impact_case = coarse_case();
    impact_case.numerics.elements_across_radius = 4;
    impact_case.shape = specimen::make_shape(specimen::uniform_cylinder, 6.4e-3, 32.4e-3);
    impact_case.velocity_m_s = 227;
    impact_case.run_until_s = 80e-6;
    impact_case.material.strength = material::StrengthModel::j2;
    impact_case.material.equation_of_state = material::EquationOfStateModel::linear;
    impact_case.material.poisson_ratio = 0.35;
    impact_case.material.bulk_modulus = 117e9 / (3 * (1 - 2 * 0.35));
    const impact::ImpactResult result = sph::simulate(impact_case);
    REQUIRE(result.status == impact::Status::stopped);
    CHECK(result.sizes.final_length_mm == Approx(21.43).epsilon(0.01));
    CHECK(result.sizes.impact_diameter_mm / 2 == Approx(7.22).epsilon(0.03));
    CHECK(result.descriptors.energy_error < 5e-3);
    CHECK(result.history.back().time_us == Approx(80));
}

TEST_CASE("a dislocation run stops, closes its energy and repeats itself", "[run]") {
    impact::ImpactCase impact_case = coarse_case();
    const impact::ImpactResult first = sph::simulate(impact_case);
    REQUIRE(first.status == impact::Status::stopped);
    CHECK(first.reason.empty());
    CHECK(first.descriptors.energy_error < 5e-3);
    CHECK(first.descriptors.stop_time_us > 30);
    CHECK(first.descriptors.stop_time_us < 80);
    CHECK(first.grain_updates > first.points * first.steps / 4);
    CHECK(first.grain_updates < first.points * first.steps);
    CHECK(first.fields.x_mm.size() == static_cast<std::size_t>(first.points));
    // Copper keeps its volume to some tenths of a percent.
    double volume = 0;
    for (const double v : first.fields.volume_mm3) volume += v;
    CHECK(volume == Approx(2010.6).epsilon(0.02));

    const impact::ImpactResult again = sph::simulate(impact_case);
    CHECK(again.sizes.final_length_mm == first.sizes.final_length_mm);
    CHECK(again.descriptors.plastic_work_J == first.descriptors.plastic_work_J);
    impact_case.seed = 2;
    const impact::ImpactResult other = sph::simulate(impact_case);
    CHECK(other.sizes.final_length_mm != first.sizes.final_length_mm);
    CHECK(other.sizes.final_length_mm ==
          Approx(first.sizes.final_length_mm).epsilon(0.01));
}

TEST_CASE("the history's foot is the one that is measured", "[run]") {
    impact::ImpactCase impact_case = coarse_case();
    impact_case.shape = specimen::make_shape(specimen::reduced_head_3mm);
    impact_case.velocity_m_s = 180;  // the head collapses, its shoulder sinks to the foot
    const impact::ImpactResult result = sph::simulate(impact_case);
    REQUIRE(result.status == impact::Status::stopped);
    CHECK(2 * result.history.back().foot_radius_mm ==
          Approx(result.sizes.impact_diameter_mm).epsilon(5e-3));
}

TEST_CASE("a run that reaches a limit says so", "[run]") {
    impact::ImpactCase impact_case = coarse_case();
    impact_case.numerics.step_limit = 20;
    const impact::ImpactResult result = sph::simulate(impact_case);
    CHECK(result.status == impact::Status::not_stopped);
    CHECK(result.reason.find("step_limit") != std::string::npos);
    CHECK(result.steps == 20);
}

TEST_CASE("a run ends when all its points' steps together are too many", "[run]") {
    impact::ImpactCase impact_case = coarse_case();
    impact_case.run_until_s = 3e-6;
    const std::int64_t whole = sph::simulate(impact_case).grain_updates;
    impact_case.numerics.point_update_limit = whole / 3;
    const impact::ImpactResult result = sph::simulate(impact_case);
    CHECK(result.status == impact::Status::not_stopped);
    CHECK(result.reason.find("point_update_limit") != std::string::npos);
    CHECK(result.grain_updates >= whole / 3);
    CHECK(result.grain_updates < whole / 2);
}

TEST_CASE("snapshots are of the start, of every interval and of the end", "[run]") {
    impact::ImpactCase impact_case = coarse_case();
    impact_case.snapshot_interval_s = 1e-6;
    impact_case.run_until_s = 2.5e-6;
    const impact::ImpactResult result = sph::simulate(impact_case);
    std::vector<double> times;
    for (const impact::Fields& fields : result.snapshots) times.push_back(fields.time_us);
    CHECK_THAT(times,
               Catch::Matchers::Approx(std::vector<double>{0, 1, 2, 2.5}).margin(1e-9));
    CHECK(result.snapshots.front().z_mm == result.snapshots.front().initial_z_mm);
}

TEST_CASE("a run that blows up fails with a reason and does not throw", "[run]") {
    impact::ImpactCase impact_case = coarse_case();
    impact_case.numerics.cfl = 3;
    const impact::ImpactResult result = sph::simulate(impact_case);
    CHECK(result.status == impact::Status::failed);
    CHECK_FALSE(result.reason.empty());
}
