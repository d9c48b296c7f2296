#include "solver/material/copper_equation_of_state.hpp"

#include "common/errors.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::material {

namespace {
// Hugoniot of copper, Marsh (ed.), LASL Shock Hugoniot Data, 1980.
constexpr double sound_speed = 3940;  // c0 [m/s]
constexpr double slope = 1.489;       // s
// Gives copper's linear expansion at 300 K, 16.6e-6 1/K, within 1 %.
constexpr double gruneisen_coefficient = 1.96;
// Beyond the spinodal (tension above 20 GPa, far past spall) the modulus has no meaning;
// a small positive one keeps sound speeds and the shear modulus real.
constexpr double modulus_floor_share = 0.05;
constexpr int newton_iterations = 20;
}  // namespace

CopperEquationOfState::CopperEquationOfState(const Parameters& parameters)
    : initial_density_(parameters.initial_density),
      specific_heat_(parameters.specific_heat),
      reference_temperature_(parameters.reference_temperature),
      thermal_density_(gruneisen_coefficient * initial_density_) {
    constexpr double gamma = gruneisen_coefficient;
    const double rho0 = initial_density_;
    const double modulus = rho0 * sound_speed * sound_speed;
    modulus_floor_ = modulus_floor_share * modulus;
    // The cold curve balances the thermal pressure of the undeformed metal.
    const double pressure = -thermal_density_ * specific_heat_ * reference_temperature_;
    const double cold_modulus = modulus + gamma * pressure;
    // d(rho dP/drho)/d(ln rho) of the cold curve, from dK/dP along the isentrope.
    const double curvature = (4 * slope - 1) * modulus + gamma * (gamma - 1) * pressure;
    linear_ = 3 * pressure / rho0;
    quadratic_ = 4.5 * (cold_modulus - 5.0 / 3 * pressure) / rho0;
    cubic_ = 4.5 * (curvature - 4 * cold_modulus + 35.0 / 9 * pressure) / rho0;
}

CopperEquationOfState::ColdState CopperEquationOfState::cold(double density) const {
    const double edge = std::cbrt(density / initial_density_);
    const double strain = 0.5 * (edge * edge - 1);
    const double strain_rate = edge * edge / 3;  // df/d(ln rho)
    const double slope_of_energy =
        linear_ + strain * (2 * quadratic_ + strain * 3 * cubic_);
    const double pressure = density * strain_rate * slope_of_energy;
    return {pressure, strain * (linear_ + strain * (quadratic_ + strain * cubic_)),
            5.0 / 3 * pressure + density * strain_rate * strain_rate *
                                     (2 * quadratic_ + 6 * strain * cubic_)};
}

ThermoState CopperEquationOfState::at(double density, double energy) const {
    const ColdState c = cold(density);
    const double heat = energy - c.energy + specific_heat_ * reference_temperature_;
    const double thermal_pressure = thermal_density_ * heat;
    const double modulus = c.bulk_modulus + thermal_density_ / density * thermal_pressure;
    // An energy below the cold curve has no temperature; it is shown as 0 K.
    return {c.pressure + thermal_pressure, std::max(heat / specific_heat_, 0.0),
            std::max(modulus, modulus_floor_)};
}

double CopperEquationOfState::density_at_temperature(double temperature) const {
    const double thermal_pressure = thermal_density_ * specific_heat_ * temperature;
    double density = initial_density_;
    for (int i = 0; i < newton_iterations; ++i) {
        const ColdState c = cold(density);
        const double change = density * (c.pressure + thermal_pressure) / c.bulk_modulus;
        density -= change;
        if (std::abs(change) < 1e-12 * initial_density_) return density;
    }
    throw NumericalError("copper has no density of zero pressure at " +
                         std::to_string(temperature) + " K");
}

double CopperEquationOfState::energy_at_temperature(double temperature) const {
    return cold(density_at_temperature(temperature)).energy +
           specific_heat_ * (temperature - reference_temperature_);
}

}  // namespace taylorcal::material
