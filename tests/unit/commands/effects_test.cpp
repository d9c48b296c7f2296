#include "common/errors.hpp"
#include "solver/commands/design.hpp"
#include "tests/unit/commands/small_batch.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::commands;
using Catch::Matchers::Contains;

namespace {

Configuration read(const nlohmann::json& document) {
    return read_configuration(JsonReader(document, "solver.json"));
}

/// Two runs with a column of an effect.
Design with_column(const std::string& name, double first, double second) {
    Design design = testing::small_design(2);
    design.input_names.push_back(name);
    design.inputs.conservativeResize(Eigen::NoChange, 6);
    design.inputs.col(5) << first, second;
    return design;
}

}  // namespace

TEST_CASE("a configuration's effects are in every case", "[effects]") {
    const Configuration rough = read({{"effects", {{"anvil_friction", 0.1}}}});
    CHECK(rough.document["effects"]["anvil_friction"] == 0.1);
    CHECK(make_case({}, rough, "shot").additions.friction_coefficient == 0.1);
    CHECK_FALSE(read(nlohmann::json::object()).document.contains("effects"));
}

TEST_CASE("wrong effects of a configuration are told with their file", "[effects]") {
    CHECK_THROWS_WITH(read({{"effects", {{"anvil_frition", 0.1}}}}),
                      Contains("solver.json") && Contains("anvil_friction"));
    CHECK_THROWS_WITH(read({{"effects", {{"anvil_friction", 0.7}}}}),
                      Contains("solver.json") && Contains("0 to 0.5"));
    CHECK_THROWS_WITH(make_case({}, read({{"effects", {{"oblique_impact", 1}}}}), "shot"),
                      Contains("shot: effect oblique_impact") && Contains("3d"));
}

TEST_CASE("an effect is a column of a design, over the configuration's", "[effects]") {
    const Configuration rough = read({{"effects", {{"anvil_friction", 0.1}}}});
    const auto cases =
        make_cases(with_column("anvil_friction", 0, 0.3), rough, "design.h5");
    CHECK(cases[0].additions.friction_coefficient == 0);
    CHECK(cases[1].additions.friction_coefficient == 0.3);
    // Where it is absent, it need not be possible.
    CHECK_NOTHROW(make_cases(with_column("oblique_impact", 0, 0), rough, "design.h5"));
    CHECK_THROWS_WITH(make_cases(with_column("oblique_impact", 0, 1), rough, "design.h5"),
                      Contains("design.h5, run 1") && Contains("axisymmetric"));
    CHECK_THROWS_WITH(make_cases(with_column("hard_skin", 0, 9), rough, "design.h5"),
                      Contains("run 1") && Contains("0 to 3"));
}
