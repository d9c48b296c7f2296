#include "common/errors.hpp"
#include "tests/unit/effects/cases.hpp"

#include <cmath>
#include <set>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::effects;
using Catch::Matchers::Contains;

TEST_CASE("every effect is described, and its figures agree", "[effects]") {
    std::set<std::string> names, symbols;
    for (const Effect& effect : effect_list()) {
        INFO(effect.name);
        CHECK(names.insert(effect.name).second);
        CHECK(symbols.insert(effect.symbol).second);
        CHECK(effect.is_signed == (effect.lowest < 0));
        CHECK((effect.lowest <= 0 && effect.highest > 0));
        CHECK(effect.prior.scale > 0);
        CHECK((effect.typical > 0 && effect.typical <= effect.highest));
        CHECK((effect.prior.kind == PriorKind::normal) == effect.is_signed);
        CHECK_FALSE(effect.geometries.empty());
        CHECK_FALSE(effect.equation.empty());
        CHECK_FALSE(effect.unit.empty());
        CHECK_FALSE(effect.description.empty());
        CHECK_FALSE(effect.source.empty());
        CHECK(effect.apply);
        for (const auto& info : material::parameter_list())
            CHECK(info.name != effect.name);
    }
}

TEST_CASE("an amplitude of zero leaves no trace in the case", "[effects]") {
    const impact::ImpactCase none;
    for (const Effect& effect : effect_list()) {
        INFO(effect.name);
        const impact::ImpactCase zero = testing::with_effect(effect.name, 0);
        CHECK(zero.velocity_m_s == none.velocity_m_s);
        CHECK(zero.material.drag_constant == none.material.drag_constant);
        const impact::Additions& a = zero.additions;
        CHECK(a.grains.slip_resistance.empty());
        CHECK(a.grains.back_stress.empty());
        CHECK(a.grains.densities.empty());
        CHECK(a.orientations.empty());
        CHECK(a.initial_density.empty());
        CHECK((a.unheated_share == 0 && a.friction_coefficient == 0));
        CHECK((a.anvil_compliance == 0 && a.anvil_tilt == 0));
    }
}

TEST_CASE("wrong effects are refused with a remedy", "[effects]") {
    CHECK_THROWS_WITH(testing::with_effect("anvil_frition", 0.1),
                      Contains("did you mean \"anvil_friction\"?"));
    CHECK_THROWS_WITH(testing::with_effect("anvil_friction", 0.6),
                      Contains("expected 0 to 0.5"));
    CHECK_THROWS_AS(testing::with_effect("anvil_friction", std::nan("")), InputError);
    CHECK_THROWS_WITH(testing::with_effect("oblique_impact", 1),
                      Contains("\"axisymmetric\"") && Contains("\"3d\""));
    impact::ImpactCase j2;
    j2.material.strength = material::StrengthModel::j2;
    CHECK_THROWS_WITH(testing::with_effect("hall_petch", 0.1, j2),
                      Contains("\"j2\"") && Contains("\"dislocation\""));
    CHECK_NOTHROW(testing::with_effect("anvil_friction", 0.1, j2));
    impact::ImpactCase cool;
    cool.material.taylor_quinney = 0.1;
    CHECK_THROWS_WITH(testing::with_effect("taylor_quinney_shift", 0.2, cool),
                      Contains("taylor_quinney of 0.1"));
    impact::ImpactCase melting;
    melting.material.reference_temperature = 1356;
    CHECK_THROWS_WITH(testing::with_effect("thermal_softening", 0.3, melting),
                      Contains("jc_melting_temperature = 1356 K") &&
                          Contains("reference_temperature = 1356 K") &&
                          Contains("Raise the first"));
    CHECK_NOTHROW(testing::with_effect("thermal_softening", 0, melting));
}
