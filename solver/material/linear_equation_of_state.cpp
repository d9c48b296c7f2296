#include "solver/material/linear_equation_of_state.hpp"

namespace taylorcal::material {

namespace {
constexpr double linear_gruneisen_coefficient = 2;
}

LinearEquationOfState::LinearEquationOfState(const Parameters& parameters)
    : initial_density_(parameters.initial_density),
      bulk_modulus_(parameters.bulk_modulus),
      specific_heat_(parameters.specific_heat),
      reference_temperature_(parameters.reference_temperature) {}

ThermoState LinearEquationOfState::at(double density, double energy) const {
    return {bulk_modulus_ * (density / initial_density_ - 1) +
                linear_gruneisen_coefficient * initial_density_ * energy,
            reference_temperature_ + energy / specific_heat_, bulk_modulus_};
}

double LinearEquationOfState::energy_at_temperature(double temperature) const {
    return specific_heat_ * (temperature - reference_temperature_);
}

double LinearEquationOfState::density_at_temperature(double temperature) const {
    const double thermal_pressure = linear_gruneisen_coefficient * initial_density_ *
                                    energy_at_temperature(temperature);
    return initial_density_ * (1 - thermal_pressure / bulk_modulus_);
}

}  // namespace taylorcal::material
