#pragma once

#include "solver/material/equation_of_state.hpp"

namespace taylorcal::material {

/// P = K0 (rho/rho0 - 1) + 2 rho0 E with a constant modulus K0 and T = T0 + E/cv. Made
/// for verification: G is constant, and a point has a closed pressure and temperature.
class LinearEquationOfState final : public EquationOfState {
  public:
    explicit LinearEquationOfState(const Parameters& parameters);
    ThermoState at(double density, double energy) const override;
    double energy_at_temperature(double temperature) const override;
    double density_at_temperature(double temperature) const override;

  private:
    double initial_density_;
    double bulk_modulus_;
    double specific_heat_;
    double reference_temperature_;
};

}  // namespace taylorcal::material
