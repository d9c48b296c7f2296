#include "solver/commands/configuration.hpp"

#include "common/errors.hpp"
#include "solver/commands/plate.hpp"
#include "solver/commands/shot.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace taylorcal;
using namespace taylorcal::commands;
using Catch::Matchers::Contains;

Configuration configuration_of(const nlohmann::json& document) {
    return read_configuration(JsonReader(document, "solver.json"));
}

}  // namespace

TEST_CASE("a finer fidelity has more elements in both geometries", "[configuration]") {
    const std::string geometry = GENERATE("axisymmetric", "3d");
    int coarser = 0;
    for (const std::string& fidelity : impact::fidelity_names()) {
        const impact::Numerics numerics =
            configuration_of({{"geometry", geometry}, {"fidelity", fidelity}}).numerics;
        CHECK(numerics.geometry == impact::geometry_from_name(geometry));
        CHECK(numerics.elements_across_radius > coarser);
        coarser = numerics.elements_across_radius;
    }
}

TEST_CASE("the material block changes what it names", "[configuration]") {
    const Configuration configuration =
        configuration_of({{"material", {{"strength", "j2"}, {"j2_yield_stress", 3e8}}}});
    CHECK(configuration.material.strength == material::StrengthModel::j2);
    CHECK(configuration.material.j2_yield_stress == 3e8);
    CHECK(configuration.material.poisson_ratio == material::Parameters{}.poisson_ratio);
    CHECK(configuration.document["geometry"] == "axisymmetric");
    CHECK(configuration.document["fidelity"] == "standard");
}

TEST_CASE("the numerics block overrides the fidelity", "[configuration]") {
    const impact::Numerics own = configuration_of(nlohmann::json::object()).numerics;
    const impact::Numerics numerics =
        configuration_of(
            {{"numerics", {{"elements_across_radius", 24}, {"hourglass", 0.15}}}})
            .numerics;
    CHECK(numerics.elements_across_radius == 24);
    CHECK(numerics.hourglass == 0.15);
    CHECK(numerics.grains_per_point == own.grains_per_point);
    CHECK(numerics.cfl == own.cfl);
}

TEST_CASE("a strength's constants must agree", "[configuration]") {
    nlohmann::json material = {{"reference_temperature", 1400}};
    CHECK_NOTHROW(make_case({}, configuration_of({{"material", material}}), "shot"));
    material["strength"] = "johnson_cook";
    const auto values = Contains(
        "jc_melting_temperature = 1356 K is not above reference_temperature = 1400 K");
    const auto remedy = Contains("Raise the first or lower the second");
    CHECK_THROWS_WITH(make_case({}, configuration_of({{"material", material}}), "shot"),
                      Contains("shot: ") && values && remedy);
    const nlohmann::json plate = {{"flyer_thickness_mm", 1},
                                  {"target_thickness_mm", 2},
                                  {"velocity_m_s", 300},
                                  {"duration_us", 1},
                                  {"material", material}};
    CHECK_THROWS_WITH(read_plate_case(JsonReader(plate, "plate.json")),
                      Contains("plate.json: ") && values && remedy);
}

TEST_CASE("a wrong configuration is refused at its key", "[configuration]") {
    CHECK_THROWS_WITH(configuration_of({{"fidelty", "fine"}}),
                      Contains("solver.json: fidelty") && Contains("\"fidelity\""));
    CHECK_THROWS_WITH(
        configuration_of({{"numerics", {{"elements_across_radius", 0}}}}),
        Contains("numerics.elements_across_radius = 0") && Contains("expected 1 to 200"));
    CHECK_THROWS_WITH(configuration_of({{"material", {{"strength", 2}}}}),
                      Contains("material.strength = 2"));
    CHECK_THROWS_WITH(configuration_of({{"material", {{"taylor_quinney", 1.5}}}}),
                      Contains("solver.json: material: taylor_quinney = 1.5"));
}
