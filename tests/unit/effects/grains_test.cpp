#include "solver/material/microstructure.hpp"
#include "solver/material/strength.hpp"
#include "tests/unit/effects/cases.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::material;
using testing::with_effect;

namespace {

/// One grain with Ys = 100 MPa whose systems all slip.
GrainBlock slipping_grain() {
    GrainBlock grain;
    grain.lanes = 1;
    grain.temperature[0] = 300;
    grain.shear_modulus[0] = 45e9;
    grain.slip_resistance[0] = 100e6;
    for (auto& density : grain.mobile) density[0] = 1e12;
    for (auto& density : grain.immobile) density[0] = 1e13;
    for (auto& speed : grain.slip_speed) speed[0] = 20;
    grain.duration = 1e-8;
    return grain;
}

double resistance(const impact::ImpactCase& impact_case, GrainBlock grain) {
    for (const GrainHook& hook : impact_case.additions.grains.slip_resistance)
        hook(grain);
    return grain.slip_resistance[0];
}

GrainBlock evolved(const impact::ImpactCase& impact_case, GrainBlock grain) {
    for (const GrainHook& hook : impact_case.additions.grains.densities) hook(grain);
    return grain;
}

/// A single grain that is compressed along z, in steps of 1e-7 s.
class Compressed {
  public:
    explicit Compressed(const impact::ImpactCase& impact_case)
        : strength_(make_strength<double>(impact_case.material,
                                          {Eigen::Quaterniond(0.9, 0.2, -0.3, 0.25)})) {
        strength_->change({impact_case.additions.grains, {}});
    }
    void move(double rate, int steps, double temperature = 300) {
        BlockInput<double> input{};
        input.velocity_gradient[0] = input.velocity_gradient[4] = broadcast(rate / 2);
        input.velocity_gradient[8] = broadcast(-rate);
        input.density = broadcast(8930.0);
        input.temperature = broadcast(temperature);
        input.shear_modulus = broadcast(45e9);
        input.time_step = 1e-7;
        for (int i = 0; i < steps; ++i) {
            strength_->update(0, input, output_);
            work_ += output_.plastic_power[0] * input.time_step;
        }
    }
    double axial_stress() const { return output_.stress_deviator[2][0]; }
    double work() const { return work_; }
    GrainState state() const { return strength_->state(0); }

  private:
    std::unique_ptr<Strength<double>> strength_;
    BlockOutput<double> output_{};
    double work_ = 0;
};

}  // namespace

TEST_CASE("slip resistance falls to melting with temperature", "[effects]") {
    const auto soft = with_effect("thermal_softening", 0.5);
    GrainBlock grain = slipping_grain();
    for (const auto& [temperature, share] :
         {std::pair{200.0, 1.0}, {300, 1}, {828, 0.75}, {1356, 0.5}, {2000, 0.5}}) {
        grain.temperature[0] = temperature;
        CHECK(resistance(soft, grain) == Approx(share * 100e6));
    }
}

TEST_CASE("refined grains are harder by k/sqrt(d) less the first grains' part",
          "[effects]") {
    const auto fine = with_effect("hall_petch", 0.12);
    GrainBlock grain = slipping_grain();
    CHECK(resistance(fine, grain) == 100e6);
    grain.annihilated_energy[0] = 4e6;
    const double d = grain_diameter(fine.material, 4e6);
    REQUIRE(d < 2e-6);
    CHECK(resistance(fine, grain) ==
          Approx(100e6 + 0.12e6 * (1 / std::sqrt(d) - 1 / std::sqrt(18e-6))));
}

TEST_CASE("the weakened fraction carries nothing at amplitude 1", "[effects]") {
    GrainBlock grain = slipping_grain();
    grain.annihilated_energy[0] = 4e6;
    const double weakened = weakened_fraction(Parameters{}, 4e6);
    REQUIRE(weakened > 0.1);
    CHECK(resistance(with_effect("damage_softening", 1), grain) ==
          Approx(100e6 * (1 - weakened)));
    grain.annihilated_energy[0] = 1e9;
    CHECK(resistance(with_effect("damage_softening", 1), grain) == 0);
}

TEST_CASE("drag is scaled at every temperature", "[effects]") {
    const auto slow = with_effect("phonon_drag", 0.5);
    CHECK(slow.material.drag_constant == 1.5 * Parameters{}.drag_constant);
    CHECK(slow.material.drag_slope == 1.5 * Parameters{}.drag_slope);
}

TEST_CASE("the forest stores k1 b rhoD V sqrt(rhoI) and keeps the sum", "[effects]") {
    const GrainBlock before = slipping_grain();
    const GrainBlock after = evolved(with_effect("forest_storage", 0.001), before);
    const double rate = 0.001 * 20 * std::sqrt(12e13) * 1e12;
    for (std::size_t d = 0; d < slip_system_count; ++d) {
        CHECK(after.immobile[d][0] - 1e13 == Approx(rate * 1e-8).epsilon(2e-3));
        CHECK(after.immobile[d][0] + after.mobile[d][0] == Approx(1.1e13));
    }
    GrainBlock still = before;
    for (auto& speed : still.slip_speed) speed[0] = 0;
    CHECK(evolved(with_effect("forest_storage", 0.001), still).immobile[0][0] == 1e13);
}

TEST_CASE("recovery takes k2 rhoI of the slip, more of it in the heat", "[effects]") {
    GrainBlock grain = slipping_grain();
    const double slip = 12 * Parameters{}.burgers_vector * 1e12 * 20 * 1e-8;
    const auto loss = [&] {
        return 1 -
               evolved(with_effect("dynamic_recovery", 2), grain).immobile[3][0] / 1e13;
    };
    CHECK(loss() == Approx(2 * slip).epsilon(1e-3));
    grain.temperature[0] = 700;
    const double activation = std::exp(0.1 / 8.617333262e-5 * (1 / 300.0 - 1 / 700.0));
    CHECK(loss() == Approx(2 * activation * slip).epsilon(1e-2));
}

TEST_CASE("a back stress adds to forward flow and takes from reverse flow", "[effects]") {
    impact::ImpactCase perfect;
    perfect.material.hardening_coefficient = 0;
    perfect.material.initial_yield_stress = 100e6;
    Compressed plain(perfect);
    Compressed leaning(with_effect("back_stress", 500, perfect));
    for (Compressed* grain : {&plain, &leaning}) grain->move(1e3, 400);
    // X_zz = 2/3 H w_zz with the plastic strain that was prescribed.
    const double shift = 2.0 / 3 * 500e6 * leaning.state().equivalent_plastic_strain;
    REQUIRE(shift > 10e6);
    CHECK(plain.axial_stress() - leaning.axial_stress() == Approx(shift).epsilon(0.05));
    CHECK(
        leaning.work() - plain.work() ==
        Approx(shift / 2 * 1.5 * leaning.state().equivalent_plastic_strain).epsilon(0.1));
    for (Compressed* grain : {&plain, &leaning}) grain->move(-1e3, 60);
    REQUIRE(plain.axial_stress() > 50e6);
    const double left = 2.0 / 3 * 500e6 * leaning.state().equivalent_plastic_strain;
    CHECK(plain.axial_stress() - leaning.axial_stress() == Approx(left).epsilon(0.05));
}

TEST_CASE("the threshold of rest and of slip is the changed one", "[effects]") {
    // Softened to a tenth, the grain slips at a load that leaves the other at rest.
    const auto soft = with_effect("thermal_softening", 0.9);
    Compressed plain{impact::ImpactCase()};
    Compressed softened(soft);
    for (Compressed* grain : {&plain, &softened}) grain->move(2e3, 2, 1356);
    CHECK(plain.state().equivalent_plastic_strain == 0);
    CHECK(softened.state().equivalent_plastic_strain > 0);
    CHECK(softened.state().slip_resistance_Pa ==
          Approx(0.1 * plain.state().slip_resistance_Pa).epsilon(1e-2));
}
