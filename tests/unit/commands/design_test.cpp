#include "solver/commands/design.hpp"

#include "common/errors.hpp"
#include "tests/unit/commands/small_batch.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace taylorcal;
using namespace taylorcal::commands;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinRel;

/// Writes a design and reads it back.
Design through_file(const Design& design) {
    const testing::TemporaryFolder folder;
    Hdf5Writer file(folder / "design.h5");
    write_design_tables(file, design);
    file.attribute("schema", std::string("taylorcal/design/1"));
    file.close();
    return read_design(folder / "design.h5");
}

std::vector<impact::ImpactCase> cases_of(const Design& design) {
    return make_cases(design, read_configuration(std::string()), "design.h5");
}

}  // namespace

TEST_CASE("a row becomes a case in SI units", "[design]") {
    Design design = testing::small_design(2);
    design.inputs.row(1) << 123, 7.595, 4, 350, 3.5;
    const impact::ImpactCase impact_case = cases_of(through_file(design))[1];
    CHECK(impact_case.shape.profile == specimen::truncated_cone);
    CHECK_THAT(impact_case.shape.length(), WithinRel(4 * 7.595e-3, 1e-12));
    CHECK_THAT(impact_case.shape.rear_radius(), WithinRel(7.595e-3 / 2, 1e-12));
    CHECK(impact_case.velocity_m_s == 123);
    CHECK(impact_case.initial_temperature_K == 350);
    CHECK(impact_case.material.hardening_coefficient == 3.5);
    CHECK(impact_case.seed == 101);
}

TEST_CASE("a design that cannot work is refused at its place", "[design]") {
    Design design = testing::small_design(3);
    SECTION("unknown input") {
        design.input_names[4] = "hardening_coeficient";
        CHECK_THROWS_WITH(through_file(design),
                          Contains("did you mean \"hardening_coefficient\"?"));
    }
    SECTION("missing input") {
        design.input_names[3] = "immobilization_velocity";
        CHECK_THROWS_WITH(through_file(design),
                          Contains("\"initial_temperature_K\" is missing"));
    }
    SECTION("input twice") {
        design.input_names.push_back("velocity_m_s");
        design.inputs.conservativeResize(Eigen::NoChange, 6);
        CHECK_THROWS_WITH(through_file(design), Contains("occurs twice"));
    }
    SECTION("run twice") {
        design.run_id[2] = design.run_id[0];
        CHECK_THROWS_WITH(through_file(design), Contains("run_id 3 occurs twice"));
    }
    SECTION("no row") {
        CHECK_THROWS_WITH(through_file(design.subset({})), Contains("no row"));
    }
    SECTION("tables of different lengths") {
        design.seed.pop_back();
        CHECK_THROWS_WITH(through_file(design), Contains("must agree"));
    }
    SECTION("unknown shape") {
        design.shape[1] = "truncated_con";
        CHECK_THROWS_WITH(cases_of(design),
                          Contains("run 2") && Contains("truncated_cone"));
    }
    SECTION("negative size") {
        design.inputs(1, 1) = -8;
        CHECK_THROWS_WITH(cases_of(design),
                          Contains("run 2") && Contains("initial_diameter_mm = -8"));
    }
    SECTION("value that is not a number") {
        design.inputs(2, 0) = std::nan("");
        CHECK_THROWS_WITH(cases_of(design),
                          Contains("run 1") && Contains("velocity_m_s"));
    }
    SECTION("parameter out of range") {
        design.inputs(0, 4) = 11;
        CHECK_THROWS_WITH(cases_of(design), Contains("run 3") && Contains("0 to 10"));
    }
}

TEST_CASE("rows are chosen by first:last", "[design]") {
    CHECK(parse_rows("1:3", 5) == std::vector<std::size_t>{1, 2});
    CHECK(parse_rows(":2", 5) == std::vector<std::size_t>{0, 1});
    CHECK(parse_rows("3:", 5) == std::vector<std::size_t>{3, 4});
    for (const std::string wrong : {"3", "3:2", "2:2", "0:6", "a:b", "-1:2", ""})
        CHECK_THROWS_AS(parse_rows(wrong, 5), InputError);
}
