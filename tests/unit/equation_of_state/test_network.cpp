#include "common/errors.hpp"
#include "emulator/inference/emulator.hpp"
#include "solver/material/copper_md_network.hpp"
#include "solver/material/network_equation_of_state.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::material;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double rho0 = 8930;  // [kg/m3]

Parameters copper_md() {
    Parameters parameters;
    set_model(parameters, "equation_of_state", "copper_md");
    return parameters;
}

emulator::Emulator committed_network() {
    return emulator::Emulator(emulator::model_from_json(
        nlohmann::json::parse(copper_md_network()), "network.json"));
}

}  // namespace

TEST_CASE("the table answers as the network does", "[eos]") {
    const emulator::Emulator network = committed_network();
    const ThermoTable& table = copper_md_table();
    const double low = table.lowest_density(), high = table.highest_density();
    double pressure = 0, temperature = 0, modulus = 0;
    emulator::Workspace workspace;
    for (int i = 0; i <= 350; ++i) {
        // Densities between the table's nodes, temperatures between its shares.
        const double density = low + (high - low) * (i + 0.37) / 351;
        for (double wanted = 110; wanted < 1300; wanted += 83) {
            const double energy = table.energy_at(density, wanted);
            emulator::Block point(2, 1), answer;
            point << static_cast<float>(density), static_cast<float>(energy);
            network.evaluate(point, 0, answer, workspace);
            const ThermoState state = table.at(density, energy);
            pressure = std::max(
                pressure, std::abs(state.pressure - static_cast<double>(answer(0, 0))));
            temperature =
                std::max(temperature,
                         std::abs(state.temperature - static_cast<double>(answer(1, 0))));
            modulus = std::max(modulus, std::abs(state.bulk_modulus -
                                                 static_cast<double>(answer(2, 0))));
        }
    }
    INFO("largest errors: " << pressure / 1e6 << " MPa, " << temperature << " K, "
                            << modulus / 1e6 << " MPa");
    CHECK(pressure < 2e6);
    CHECK(temperature < 0.1);
    CHECK(modulus < 20e6);
}

TEST_CASE("copper of molecular dynamics is at rest at its reference state", "[eos]") {
    Parameters parameters = copper_md();
    parameters.initial_density = GENERATE(8930.0, 8810.0);
    parameters.reference_temperature = GENERATE(300.0, 500.0);
    const auto eos = make_equation_of_state(parameters);
    const double T0 = parameters.reference_temperature;
    CHECK_THAT(eos->density_at_temperature(T0),
               WithinRel(parameters.initial_density, 1e-9));
    CHECK_THAT(eos->energy_at_temperature(T0), WithinAbs(0, 1e-3));
    const ThermoState state = eos->at(parameters.initial_density, 0);
    CHECK_THAT(state.pressure, WithinAbs(0, 1e3));
    CHECK_THAT(state.temperature, WithinAbs(T0, 1e-3));
}

TEST_CASE("copper of molecular dynamics is near measured copper", "[eos]") {
    const auto eos = make_equation_of_state(copper_md());
    const ThermoState state = eos->at(rho0, 0);
    CHECK_THAT(state.bulk_modulus, WithinRel(137.1e9, 0.03));
    const double expansion =
        std::log(eos->density_at_temperature(290) / eos->density_at_temperature(310)) /
        60;
    CHECK_THAT(expansion, WithinRel(16.6e-6, 0.04));
    const double heat =
        (eos->energy_at_temperature(310) - eos->energy_at_temperature(290)) / 20;
    CHECK_THAT(heat, WithinRel(385, 0.06));
    // The state behind a shock at measured speed, Us = 3.94 + 1.489 up, to 60 GPa.
    const double up = GENERATE(200.0, 600.0, 1200.0);
    const double Us = 3940 + 1.489 * up;
    const double density = rho0 * Us / (Us - up);
    CHECK_THAT(eos->at(density, up * up / 2).pressure, WithinRel(rho0 * Us * up, 0.05));
}

TEST_CASE("modulus and pressure of the network belong together", "[eos]") {
    const auto eos = make_equation_of_state(copper_md());
    const double rho = GENERATE(0.95, 1.0, 1.03, 1.1, 1.3) * rho0;
    const double energy = GENERATE(1e4, 1e5, 3e5) + (rho > 1.2 * rho0 ? 6e5 : 0.0);
    const double d = 2e-3 * rho;
    const ThermoState here = eos->at(rho, energy);
    const double above =
        eos->at(rho + d, energy + here.pressure / (rho * rho) * d).pressure;
    const double below =
        eos->at(rho - d, energy - here.pressure / (rho * rho) * d).pressure;
    CHECK_THAT(here.bulk_modulus, WithinRel(rho * (above - below) / (2 * d), 0.02));
}

TEST_CASE("states beyond the data go on smoothly or are refused", "[eos]") {
    const auto eos = make_equation_of_state(copper_md());
    const double edge = copper_md_table().energy_at(rho0, 1300);
    const ThermoState inside = eos->at(rho0, edge - 50),
                      outside = eos->at(rho0, edge + 50);
    CHECK_THAT(inside.pressure, WithinAbs(outside.pressure, 5e6));
    CHECK_THAT(inside.temperature, WithinAbs(outside.temperature, 1));
    const ThermoState hot = eos->at(rho0, edge + 2e5);
    CHECK_THAT(hot.temperature, WithinAbs(1800, 100));
    CHECK(hot.pressure > outside.pressure);
    CHECK(eos->at(rho0, eos->energy_at_temperature(30)).temperature < 100);

    CHECK_THROWS_AS(eos->at(rho0, 3e6), NumericalError);
    CHECK_THROWS_AS(eos->at(rho0, -1e6), NumericalError);
    CHECK_THROWS_AS(eos->at(0.5 * rho0, 0), NumericalError);
    CHECK_THROWS_AS(eos->at(std::nan(""), 0), NumericalError);
    CHECK_THROWS_WITH(eos->at(2 * rho0, 0), Contains("beyond the equation of state"));
}

TEST_CASE("the network's digest tells that it is another", "[eos]") {
    CHECK(copper_md_digest().size() == 64);
}
