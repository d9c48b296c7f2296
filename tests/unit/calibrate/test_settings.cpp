#include "calibrate/settings/settings.hpp"
#include "common/errors.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json good() {
    return {{"parameters",
             {{{"name", "hardening_coefficient"}, {"lower", 0}, {"upper", 10}},
              {{"name", "rho_immobile_initial"},
               {"lower", 1e10},
               {"upper", 1e15},
               {"prior", "log_uniform"},
               {"scope", "per_lot"}}}},
            {"fit_sizes", {"final_length_mm"}},
            {"unexplained_spread", {{"prior_scale", 0.02}, {"grid", {0, 0.01}}}}};
}

std::string complaint(const json& settings) {
    try {
        parse_settings(settings, "calibrate.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("settings are read with their defaults", "[settings]") {
    const Settings settings = parse_settings(good(), "calibrate.json");
    REQUIRE(settings.parameters.size() == 2);
    CHECK_FALSE(settings.parameters[0].log_uniform);
    CHECK(settings.parameters[1].log_uniform);
    CHECK(settings.parameters[1].per_lot);
    CHECK(settings.velocity_sd_relative == 0.01);
    CHECK(settings.unexplained_spread->grid.size() == 2);
    json none = good();
    none["unexplained_spread"] = nullptr;
    CHECK_FALSE(parse_settings(none, "calibrate.json").unexplained_spread.has_value());
}

TEST_CASE("a normal prior around zero is read with its scale", "[settings]") {
    json settings = good();
    settings["parameters"][0] = {{"name", "anvil_friction"},
                                 {"lower", 0},
                                 {"upper", 0.5},
                                 {"prior", "half_normal"},
                                 {"scale", 0.1}};
    CHECK(parse_settings(settings, "calibrate.json").parameters[0].normal_scale == 0.1);
    CHECK_FALSE(parse_settings(good(), "calibrate.json").parameters[0].normal_scale);
    settings["parameters"][0]["scale"] = 0;
    CHECK_THAT(complaint(settings), Contains("scale") && Contains("positive"));
    settings["parameters"][0]["scale"] = 0.01;
    settings["parameters"][0]["lower"] = 0.2;
    CHECK_THAT(complaint(settings), Contains("scale") && Contains("0.2 to 0.5"));
    settings["parameters"][0]["lower"] = -0.2;
    CHECK_THAT(complaint(settings), Contains("lower") && Contains("use normal"));
    settings["parameters"][0]["prior"] = "uniform";
    CHECK_THAT(complaint(settings), Contains("scale") && Contains("not a known key"));
}

TEST_CASE("bad settings are refused with the key's name", "[settings]") {
    json bad = good();
    SECTION("unknown key") {
        bad["fit_size"] = 1;
        CHECK_THAT(complaint(bad), Contains("calibrate.json") && Contains("fit_sizes"));
    }
    SECTION("range upside down") {
        bad["parameters"][0]["upper"] = -1;
        CHECK_THAT(complaint(bad), Contains("upper") && Contains("-1"));
    }
    SECTION("logarithm of zero") {
        bad["parameters"][1]["lower"] = 0;
        CHECK_THAT(complaint(bad), Contains("lower") && Contains("log_uniform"));
    }
    SECTION("unknown size") {
        bad["fit_sizes"] = {"final_lenght_mm"};
        CHECK_THAT(complaint(bad), Contains("Did you mean \"final_length_mm\"?"));
    }
    SECTION("the same parameter twice") {
        bad["parameters"][1]["name"] = "hardening_coefficient";
        CHECK_THAT(complaint(bad), Contains("twice"));
    }
    SECTION("falling grid") {
        bad["unexplained_spread"]["grid"] = {0.02, 0.01};
        CHECK_THAT(complaint(bad), Contains("grid"));
    }
    SECTION("a grid that does not begin at 0") {
        bad["unexplained_spread"]["grid"] = {0.5};
        CHECK_THAT(complaint(bad), Contains("grid must hold rising"));
    }
    SECTION("no parameters") {
        bad["parameters"] = json::array();
        CHECK_THAT(complaint(bad), Contains("parameters"));
    }
    SECTION("too few draws") {
        bad["draws"] = 3;
        CHECK_THAT(complaint(bad), Contains("draws") && Contains("100"));
    }
}

TEST_CASE("plain draws are for a few shared parameters", "[settings]") {
    json settings = good();
    settings["draw_sequence"] = "sobol";
    CHECK_THAT(complaint(settings), Contains("draw_sequence") && Contains("prior"));
    settings["draws_from"] = "prior";
    CHECK_THAT(complaint(settings), Contains("draws_from") && Contains("adapted"));
    settings["parameters"][1]["scope"] = "shared";
    const Settings read = parse_settings(settings, "calibrate.json");
    CHECK(read.draws_from == DrawsFrom::prior);
    CHECK(read.draw_sequence == DrawSequence::sobol);
    CHECK(parse_settings(good(), "calibrate.json").draws_from == DrawsFrom::adapted);
}

TEST_CASE("shots share the network's error unless rows are taken one by one",
          "[settings]") {
    json settings = good();
    CHECK(parse_settings(settings, "calibrate.json").network_errors ==
          NetworkErrors::common);
    settings["likelihood"] = "paper";
    CHECK(parse_settings(settings, "calibrate.json").network_errors ==
          NetworkErrors::independent);
    settings["network_errors"] = "common";
    CHECK_THAT(complaint(settings),
               Contains("network_errors") && Contains("independent"));
}
