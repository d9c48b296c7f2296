#pragma once

#include "solver/material/parameters.hpp"

#include <memory>

namespace taylorcal::material {

/// What an equation of state answers at (rho, E). SI units.
struct ThermoState {
    double pressure;      ///< P [Pa]
    double temperature;   ///< T [K]
    double bulk_modulus;  ///< adiabatic K = rho (dP/drho)_S [Pa]
};

/// P, T and K of (density [kg/m3], hydrostatic specific energy E [J/kg]); E = 0 at
/// (initial_density, reference_temperature).
class EquationOfState {
  public:
    virtual ~EquationOfState() = default;
    virtual ThermoState at(double density, double energy) const = 0;
    /// Energy [J/kg] and density [kg/m3] of the metal at zero pressure and `temperature`.
    virtual double energy_at_temperature(double temperature) const = 0;
    virtual double density_at_temperature(double temperature) const = 0;
};

std::unique_ptr<EquationOfState> make_equation_of_state(const Parameters& parameters);

/// G = (3/2) K (1 - 2 mu)/(1 + mu), Eq. 26.
inline double shear_modulus(double bulk_modulus, double poisson_ratio) {
    return 1.5 * bulk_modulus * (1 - 2 * poisson_ratio) / (1 + poisson_ratio);
}

}  // namespace taylorcal::material
