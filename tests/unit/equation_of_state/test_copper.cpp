#include "solver/material/equation_of_state.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal::material;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double rho0 = 8930;  // [kg/m3]
constexpr double T0 = 300;     // [K]

/// Follows dE = P/rho^2 drho from (density, energy) by classical Runge-Kutta.
double energy_along_isentrope(const EquationOfState& eos, double density, double energy,
                              double end_density) {
    constexpr int steps = 64;
    const double h = (end_density - density) / steps;
    const auto slope = [&](double rho, double e) {
        return eos.at(rho, e).pressure / (rho * rho);
    };
    for (int i = 0; i < steps; ++i, density += h) {
        const double k1 = slope(density, energy);
        const double k2 = slope(density + h / 2, energy + h / 2 * k1);
        const double k3 = slope(density + h / 2, energy + h / 2 * k2);
        const double k4 = slope(density + h, energy + h * k3);
        energy += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return energy;
}

/// Shock speed at particle speed `up` from the jump conditions, by bisection.
double shock_speed(const EquationOfState& eos, double up) {
    double low = up * 1.2 + 1000, high = 20000;
    while (high - low > 1e-6) {
        const double Us = 0.5 * (low + high);
        const double density = rho0 * Us / (Us - up);
        const double excess = eos.at(density, 0.5 * up * up).pressure - rho0 * Us * up;
        (excess > 0 ? low : high) = Us;
    }
    return 0.5 * (low + high);
}

}  // namespace

TEST_CASE("copper is at rest at its reference state", "[eos]") {
    const auto eos = make_equation_of_state(Parameters{});
    const ThermoState state = eos->at(rho0, 0);
    CHECK_THAT(state.pressure, WithinAbs(0, 1e-3));
    CHECK_THAT(state.temperature, WithinRel(T0, 1e-12));
    CHECK_THAT(state.bulk_modulus, WithinRel(rho0 * 3940 * 3940, 1e-12));
}

TEST_CASE("copper follows its Hugoniot within 1 % to 60 GPa", "[eos]") {
    const auto eos = make_equation_of_state(Parameters{});
    for (double up = 20; rho0 * (3940 + 1.489 * up) * up < 60e9; up += 20) {
        const double Us = shock_speed(*eos, up);
        INFO("up = " << up);
        CHECK_THAT(Us, WithinRel(3940 + 1.489 * up, 0.01));
        CHECK_THAT(rho0 * Us * up, WithinRel(rho0 * (3940 + 1.489 * up) * up, 0.01));
    }
}

TEST_CASE("the modulus of copper is rho dP/drho along the isentrope", "[eos]") {
    const auto eos = make_equation_of_state(Parameters{});
    const double ratio = GENERATE(0.9, 0.97, 1.0, 1.05, 1.2, 1.5);
    const double heat = GENERATE(0.0, 5e4, 4e5);
    const double rho = ratio * rho0;
    const double energy = energy_along_isentrope(*eos, rho0, heat, rho);
    const double d = 1e-4 * rho;
    const double above =
        eos->at(rho + d, energy_along_isentrope(*eos, rho, energy, rho + d)).pressure;
    const double below =
        eos->at(rho - d, energy_along_isentrope(*eos, rho, energy, rho - d)).pressure;
    CHECK_THAT(eos->at(rho, energy).bulk_modulus,
               WithinRel(rho * (above - below) / (2 * d), 1e-6));
}

TEST_CASE("the temperature of copper follows d ln T = Gamma d ln rho on an isentrope",
          "[eos]") {
    // Gamma rho = 1.96 rho0, so T = T0 exp(1.96 (1 - rho0/rho)): pressure and heat belong
    // together.
    const auto eos = make_equation_of_state(Parameters{});
    const double ratio = GENERATE(0.9, 1.1, 1.4);
    const double energy = energy_along_isentrope(*eos, rho0, 0, ratio * rho0);
    CHECK_THAT(eos->at(ratio * rho0, energy).temperature,
               WithinRel(T0 * std::exp(1.96 * (1 - 1 / ratio)), 1e-6));
}

TEST_CASE("copper on its cold curve has P = rho^2 dE/drho", "[eos]") {
    const auto eos = make_equation_of_state(Parameters{});
    // Energy of 0 K at each density: the temperature falls linearly with the energy.
    const auto cold_energy = [&](double rho) {
        constexpr double hot = 1e8;
        return hot - 385 * eos->at(rho, hot).temperature;
    };
    const double rho = GENERATE(0.8, 1.0, 1.3, 1.9) * rho0;
    const double d = 1e-4 * rho;
    const double slope = (cold_energy(rho + d) - cold_energy(rho - d)) / (2 * d);
    const double scale = rho0 * 3940 * 3940;
    CHECK_THAT(eos->at(rho, cold_energy(rho)).pressure,
               WithinAbs(rho * rho * slope, 1e-6 * scale));
}

TEST_CASE("copper answers finite, usable states far from rest", "[eos]") {
    const auto eos = make_equation_of_state(Parameters{});
    double last_pressure = -1e300;
    for (double ratio = 0.5; ratio <= 2.001; ratio += 0.01) {
        for (const double energy : {-1e5, 0.0, 1e5, 1e6}) {
            const ThermoState state = eos->at(ratio * rho0, energy);
            INFO("density ratio " << ratio << ", energy " << energy);
            CHECK(std::isfinite(state.pressure));
            CHECK(state.temperature >= 0);
            CHECK(std::isfinite(state.temperature));
            CHECK(state.bulk_modulus > 0);
            CHECK(std::isfinite(state.bulk_modulus));
        }
        const double pressure = eos->at(ratio * rho0, 1e5).pressure;
        CHECK(pressure > last_pressure);
        last_pressure = pressure;
    }
}

TEST_CASE("hot copper at zero pressure has expanded as copper does", "[eos]") {
    const auto eos = make_equation_of_state(Parameters{});
    CHECK_THAT(eos->density_at_temperature(T0), WithinRel(rho0, 1e-12));
    CHECK_THAT(eos->energy_at_temperature(T0), WithinAbs(0, 1e-6));
    const double T = GENERATE(77.0, 500.0, 900.0);
    const ThermoState state =
        eos->at(eos->density_at_temperature(T), eos->energy_at_temperature(T));
    CHECK_THAT(state.pressure, WithinAbs(0, 1e3));
    CHECK_THAT(state.temperature, WithinRel(T, 1e-9));
    // Linear expansion measured near room temperature: 16.6e-6 1/K.
    const double expansion = std::cbrt(rho0 / eos->density_at_temperature(T0 + 10)) - 1;
    CHECK_THAT(expansion, WithinRel(166e-6, 0.02));
}
