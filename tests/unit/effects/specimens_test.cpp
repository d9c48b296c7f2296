#include "tests/unit/effects/cases.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace taylorcal;
using impact::Geometry;
using testing::short_bar;
using testing::with_effect;

namespace {

/// Which way the final length goes at the typical amplitude.
struct Direction {
    const char* effect;
    int sign;
};

impact::ImpactResult stopped(const impact::ImpactCase& impact_case) {
    impact::ImpactResult result = impact::simulate(impact_case);
    INFO(result.reason);
    CHECK(result.status == impact::Status::stopped);
    CHECK(result.descriptors.energy_error < 0.01);
    return result;
}

double length(const impact::ImpactResult& result) { return result.sizes.final_length_mm; }

impact::ImpactCase typical(const std::string& name, const impact::ImpactCase& base) {
    return with_effect(name, effects::find_effect(name).typical, base);
}

bool same(const impact::ImpactResult& a, const impact::ImpactResult& b) {
    return observe::size_values(a.sizes) == observe::size_values(b.sizes) &&
           a.fields.temperature_K == b.fields.temperature_K &&
           a.fields.x_mm == b.fields.x_mm && a.fields.z_mm == b.fields.z_mm;
}

}  // namespace

TEST_CASE("each effect moves the length of a bar its way", "[effects]") {
    const impact::ImpactCase base = short_bar(Geometry::axisymmetric);
    const impact::ImpactResult without = stopped(base);
    for (const Direction& d : {Direction{"thermal_softening", -1},
                               {"hall_petch", 1},
                               {"damage_softening", -1},
                               {"phonon_drag", 1},
                               {"back_stress", 1},
                               {"rod_texture", 1},
                               {"hard_skin", 1},
                               {"forest_storage", 1},
                               {"elastic_anvil", 1},
                               {"dynamic_recovery", -1},
                               {"velocity_bias", -1}}) {
        INFO(d.effect);
        const double change = length(stopped(typical(d.effect, base))) - length(without);
        CAPTURE(change);
        CHECK(d.sign * change > 1e-4);
    }
    const impact::ImpactResult rough = stopped(typical("anvil_friction", base));
    CHECK(rough.sizes.impact_diameter_mm < without.sizes.impact_diameter_mm - 0.05);
    // A third of the heat less: a slightly stiffer foot, whereas the length changes by
    // 1e-5 either way, from one orientation seed to another.
    const impact::ImpactResult cool = stopped(typical("taylor_quinney_shift", base));
    const auto rise = [&](const impact::ImpactResult& result) {
        return result.descriptors.largest_temperature_K - base.initial_temperature_K;
    };
    CHECK(rise(cool) / rise(without) == Approx((0.9 - 0.3) / 0.9).epsilon(0.03));
    CHECK(cool.sizes.impact_diameter_mm < without.sizes.impact_diameter_mm - 1e-3);
}

TEST_CASE("particles answer to the effects as cells do", "[effects]") {
    const impact::ImpactCase base = short_bar(Geometry::three_dimensional);
    const impact::ImpactResult without = stopped(base);
    const impact::ImpactResult rough = stopped(typical("anvil_friction", base));
    CHECK(rough.sizes.impact_diameter_mm < without.sizes.impact_diameter_mm - 0.05);
    CHECK(length(stopped(typical("elastic_anvil", base))) > length(without) + 1e-3);
    CHECK(length(stopped(typical("thermal_softening", base))) < length(without) - 1e-3);
    // Grains of the tilted side yield first; the bar does not become longer.
    const impact::ImpactResult tilted = stopped(typical("oblique_impact", base));
    CHECK_FALSE(same(tilted, without));
}

TEST_CASE("only an amplitude changes a run, and not its last bit otherwise",
          "[effects]") {
    const Geometry geometry =
        GENERATE(Geometry::axisymmetric, Geometry::three_dimensional);
    impact::ImpactCase base = short_bar(geometry);
    base.run_until_s = 1e-6;
    const impact::ImpactResult without = impact::simulate(base);
    effects::Amplitudes none;
    for (const effects::Effect& effect : effects::effect_list())
        effects::set_amplitude(none, effect.name, 0);
    impact::ImpactCase with_none = base;
    effects::apply_effects(none, with_none);
    CHECK(same(impact::simulate(with_none), without));
    for (const effects::Effect& effect : effects::effect_list()) {
        INFO(effect.name);
        const auto& possible = effect.geometries;
        if (std::find(possible.begin(), possible.end(), geometry) == possible.end())
            continue;
        CHECK_FALSE(same(impact::simulate(typical(effect.name, base)), without));
    }
}

TEST_CASE("a biased velocity is the other velocity to the last bit", "[effects]") {
    impact::ImpactCase base = short_bar(Geometry::axisymmetric);
    base.run_until_s = 2e-6;
    impact::ImpactCase faster = base;
    faster.velocity_m_s *= 1 + 0.02;
    CHECK(same(impact::simulate(with_effect("velocity_bias", 0.02, base)),
               impact::simulate(faster)));
}
