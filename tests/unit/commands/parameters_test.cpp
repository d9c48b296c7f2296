#include "solver/material/parameters.hpp"

#include "common/errors.hpp"

#include <set>

#include <catch2/catch.hpp>

namespace {

using namespace taylorcal;
using namespace taylorcal::material;
using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("every parameter is listed once and its default is in range", "[parameters]") {
    std::set<std::string> names;
    std::set<double*> members;
    Parameters parameters;
    for (const ParameterInfo& info : parameter_list()) {
        INFO(info.name);
        CHECK(names.insert(info.name).second);
        CHECK(members.insert(&(parameters.*info.member)).second);
        CHECK(parameters.*info.member >= info.lowest);
        CHECK(parameters.*info.member <= info.highest);
        CHECK_FALSE(info.symbol.empty());
        CHECK_FALSE(info.unit.empty());
        CHECK_FALSE(info.source.empty());
    }
    // All doubles of the struct: what precedes the first is the two models.
    const auto doubles =
        (sizeof(Parameters) - offsetof(Parameters, rho_immobile_initial)) /
        sizeof(double);
    CHECK(parameter_list().size() == doubles);
}

TEST_CASE("setting a parameter by name changes it alone", "[parameters]") {
    for (const ParameterInfo& info : parameter_list()) {
        INFO(info.name);
        Parameters parameters;
        set_parameter(parameters, info.name, info.highest);
        for (const ParameterInfo& other : parameter_list())
            CHECK(parameters.*other.member ==
                  (other.name == info.name ? info.highest : Parameters{}.*other.member));
    }
}

TEST_CASE("wrong parameters are refused with a remedy", "[parameters]") {
    Parameters parameters;
    CHECK_THROWS_WITH(set_parameter(parameters, "hardening_coeficient", 2),
                      Contains("did you mean \"hardening_coefficient\"?"));
    CHECK_THROWS_WITH(set_parameter(parameters, "hardening_coefficient", 10.5),
                      Contains("expected 0 to 10"));
    CHECK_THROWS_AS(set_parameter(parameters, "hardening_coefficient", std::nan("")),
                    InputError);
    CHECK(parameters.hardening_coefficient == Parameters{}.hardening_coefficient);
}

TEST_CASE("models are chosen by word", "[parameters]") {
    Parameters parameters;
    set_model(parameters, "strength", "johnson_cook");
    set_model(parameters, "equation_of_state", "linear");
    CHECK(parameters.strength == StrengthModel::johnson_cook);
    CHECK(parameters.equation_of_state == EquationOfStateModel::linear);
    CHECK_THROWS_WITH(set_model(parameters, "strength", "elastc"), Contains("elastic"));
    CHECK_THROWS_WITH(set_model(parameters, "bulk_modulus", "stiff"),
                      Contains("expected a number"));
}
