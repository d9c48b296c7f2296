#include "solver/material/network_equation_of_state.hpp"

#include "common/errors.hpp"
#include "common/sha256.hpp"
#include "emulator/inference/emulator.hpp"
#include "solver/material/copper_md_network.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal::material {

namespace {
// The isotherms of the data that the committed network learnt.
constexpr double coldest_isotherm = 100;   // [K]
constexpr double hottest_isotherm = 1300;  // [K]
}  // namespace

NetworkEquationOfState::NetworkEquationOfState(const ThermoTable& table,
                                               const Parameters& parameters)
    : table_(table) {
    const double density = resting_density(parameters.reference_temperature);
    zero_of_energy_ = table_.energy_at(density, parameters.reference_temperature);
    scale_ = parameters.initial_density / density;
}

ThermoState NetworkEquationOfState::at(double density, double energy) const {
    ThermoState state = table_.at(density / scale_, energy + zero_of_energy_);
    state.pressure *= scale_;
    state.bulk_modulus *= scale_;
    return state;
}

double NetworkEquationOfState::energy_at_temperature(double temperature) const {
    return table_.energy_at(resting_density(temperature), temperature) - zero_of_energy_;
}

double NetworkEquationOfState::density_at_temperature(double temperature) const {
    return scale_ * resting_density(temperature);
}

double NetworkEquationOfState::resting_density(double temperature) const {
    const auto pressure = [&](double density) {
        return table_.at(density, table_.energy_at(density, temperature)).pressure;
    };
    double low = table_.lowest_density(), high = table_.highest_density();
    if (!(pressure(low) < 0 && pressure(high) > 0))
        throw NumericalError(fmt::format(
            "the network's metal has no density of zero pressure at {} K", temperature));
    while (high - low > 1e-12 * high) {
        const double middle = (low + high) / 2;
        (pressure(middle) < 0 ? low : high) = middle;
    }
    return (low + high) / 2;
}

const ThermoTable& copper_md_table() {
    static const ThermoTable table(emulator::Emulator(emulator::model_from_json(
                                       nlohmann::json::parse(copper_md_network()),
                                       "the built-in network copper_md")),
                                   coldest_isotherm, hottest_isotherm);
    return table;
}

std::string copper_md_digest() {
    static const std::string hex = sha256(copper_md_network());
    return hex;
}

}  // namespace taylorcal::material
