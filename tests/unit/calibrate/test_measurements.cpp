#include "calibrate/comparison/words.hpp"
#include "calibrate/measurements/data_set.hpp"
#include "calibrate/measurements/read_table.hpp"
#include "common/errors.hpp"
#include "tests/unit/calibrate/table_file.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;

namespace {

const std::string header =
    "id,lot,use,shape,initial_temperature_K,velocity_m_s,initial_diameter_mm,"
    "initial_length_mm,final_length_mm,final_length_mm_sd,source\n";
const std::string row = "a,one,calibrate,uniform_cylinder,295,150,8,40,30,0.2,paper\n";

std::vector<Shot> read(const std::string& text) {
    const toys::TemporaryFile file("measurements.csv", text);
    return read_measurements(file.path());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

/// The message of the InputError that reading the table throws.
std::string complaint(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("a table is read as it stands", "[measurements]") {
    const auto shots = read(header + row +
                            "b,two,validate,uniform_cylinder,295,160,8,40,,,\"a, b\"\n"
                            "c,two,ignore,truncated_cone,295,170,8,40,29,0.3,paper\n");
    REQUIRE(shots.size() == 3);
    CHECK(shots[0].sizes.at(0).value_mm == 30);
    CHECK(shots[0].sizes.at(0).sd_mm == 0.2);
    CHECK(shots[1].use == Use::validate);
    CHECK(shots[1].sizes.empty());
    CHECK(shots[1].source == "a, b");
    const DataSet set = make_data_set(shots, {"final_length_mm"});
    CHECK(set.data.size() == 1);  // b has no size, c is ignored
    CHECK_THROWS_AS(make_data_set(shots, {"head_length_mm"}), InputError);
}

TEST_CASE("a specimen may have measures of its own", "[measurements]") {
    const std::string own = "truncated_cone_2.5mm_by_9mm_of_7.6mm_by_25.4mm";
    const std::vector<Shot> shots = read(header + replaced(row, "uniform_cylinder", own));
    CHECK(shots.at(0).shape == own);
    CHECK(shape_in_words(own) == "2.5-mm cone by 9 mm of 7.6 mm by 25.4 mm");
    CHECK(shape_in_words("reduced_head_3mm") == "3-mm head");
    CHECK(shape_in_words("uniform_cylinder") == "uniform cylinder");
}

TEST_CASE("nothing undeformed is a measurement, no length is a mistake",
          "[measurements]") {
    const std::string undeformed =
        replaced(header, "final_length_mm,final_length_mm_sd",
                 "undeformed_length_mm,undeformed_length_mm_sd");
    const DataSet set = make_data_set(
        read(undeformed + replaced(row, "30,0.2", "0.0,0.8")), {"undeformed_length_mm"});
    CHECK(set.data.at(0).measured_mm(0) == 0);
    CHECK(set.data.at(0).scale_mm(0) == 40);
    CHECK_THAT(complaint(undeformed + replaced(row, "30,0.2", "-1,0.8")),
               Contains("line 2") && Contains("not a positive"));
    CHECK_THAT(complaint(header + replaced(row, "30,0.2", "0.0,0.8")),
               Contains("not a positive"));
}

TEST_CASE("bad tables are refused with place and remedy", "[measurements]") {
    SECTION("empty") {
        CHECK_THAT(complaint(header), Contains("empty") && Contains("Add"));
    }
    SECTION("missing column") {
        CHECK_THAT(complaint(replaced(header, "lot,", "") + replaced(row, "one,", "")),
                   Contains("line 1") && Contains("\"lot\" is missing"));
    }
    SECTION("wrong unit suffix") {
        CHECK_THAT(
            complaint(replaced(header, "velocity_m_s", "velocity_km_s") + row),
            Contains("velocity_km_s") && Contains("Did you mean \"velocity_m_s\"?"));
    }
    SECTION("duplicate id") {
        CHECK_THAT(complaint(header + row + row),
                   Contains("line 3") && Contains("id") && Contains("twice"));
    }
    SECTION("unknown shape") {
        CHECK_THAT(
            complaint(header + replaced(row, "uniform_cylinder", "uniform_cilinder")),
            Contains("line 2") && Contains("Did you mean \"uniform_cylinder\"?"));
    }
    SECTION("shape without its measures") {
        CHECK_THAT(
            complaint(header + replaced(row, "uniform_cylinder", "reduced_head_5")),
            Contains("line 2") && Contains("Did you mean \"reduced_head_"));
    }
    SECTION("unknown use") {
        CHECK_THAT(complaint(header + replaced(row, "calibrate", "fit")),
                   Contains("use") && Contains("calibrate, validate, ignore"));
    }
    SECTION("negative length") {
        CHECK_THAT(complaint(header + replaced(row, ",30,", ",-30,")),
                   Contains("line 2") && Contains("final_length_mm") && Contains("-30"));
    }
    SECTION("zero diameter") {
        CHECK_THAT(complaint(header + replaced(row, ",8,", ",0,")),
                   Contains("initial_diameter_mm"));
    }
    SECTION("no standard deviation") {
        CHECK_THAT(complaint(header + replaced(row, ",0.2,", ",,")),
                   Contains("final_length_mm_sd") && Contains("empty"));
    }
    SECTION("zero standard deviation") {
        CHECK_THAT(complaint(header + replaced(row, ",0.2,", ",0,")),
                   Contains("final_length_mm_sd"));
    }
    SECTION("no column of standard deviations") {
        CHECK_THAT(complaint(replaced(header, "final_length_mm_sd,", "") +
                             replaced(row, "0.2,", "")),
                   Contains("final_length_mm_sd"));
    }
    SECTION("no velocity") {
        CHECK_THAT(complaint(header + replaced(row, ",150,", ",,")),
                   Contains("velocity_m_s") && Contains("empty"));
    }
    SECTION("not a number") {
        CHECK_THAT(complaint(header + replaced(row, ",150,", ",fast,")),
                   Contains("velocity_m_s") && Contains("fast"));
    }
    SECTION("no source") {
        CHECK_THAT(complaint(header + replaced(row, ",paper", ",")), Contains("source"));
    }
}

TEST_CASE("a score of the outline may have either sign, its error must not",
          "[measurements]") {
    const std::string columns = replaced(header, "final_length_mm,final_length_mm_sd",
                                         "outline_pc_1,outline_pc_1_sd");
    const std::string negative = replaced(row, "30,0.2", "-0.12,0.02");
    const auto shots = read(columns + negative);
    REQUIRE(shots.at(0).sizes.size() == 1);
    CHECK(shots[0].sizes[0].value_mm == -0.12);
    // Relative to the initial diameter: a score may be zero.
    CHECK(make_data_set(shots, {"outline_pc_1"}).data.at(0).scale_mm(0) == 8);

    const std::string no_error = complaint(columns + replaced(negative, "0.02", ""));
    CHECK_THAT(no_error, Contains("outline_pc_1_sd") && Contains("is empty"));
    CHECK_THAT(complaint(columns + replaced(negative, "0.02", "-0.02")),
               Contains("outline_pc_1_sd") && Contains("is not a positive"));
    CHECK_THAT(complaint(columns + replaced(negative, "-0.12", "inf")),
               Contains("outline_pc_1"));
}
