#pragma once

#include "solver/material/equation_of_state.hpp"

namespace taylorcal::material {

/// Copper: a cold curve cubic in the Eulerian strain f = ((rho/rho0)^(2/3) - 1)/2
/// (third-order Birch-Murnaghan, Phys. Rev. 71, 809 (1947), expanded about rho0 instead
/// of the slightly larger density at 0 K) and a Mie-Grueneisen thermal part with constant
/// Gamma rho and cv:
///     P = P_cold(rho) + Gamma0 rho0 cv T,  E = E_cold(rho) + cv (T - T0).
/// The three coefficients follow in closed form from P = 0, K = rho0 c0^2 and
/// dK/dP = 4 s - 1 at (rho0, T0), the foot of the Hugoniot Us = c0 + s up.
class CopperEquationOfState final : public EquationOfState {
  public:
    explicit CopperEquationOfState(const Parameters& parameters);
    ThermoState at(double density, double energy) const override;
    double energy_at_temperature(double temperature) const override;
    double density_at_temperature(double temperature) const override;

  private:
    struct ColdState {
        double pressure;      ///< rho^2 dE_cold/drho [Pa]
        double energy;        ///< zero at rho0 [J/kg]
        double bulk_modulus;  ///< rho dP_cold/drho [Pa]
    };
    ColdState cold(double density) const;

    double initial_density_;
    double specific_heat_;
    double reference_temperature_;
    double thermal_density_;             ///< Gamma rho, constant [kg/m3]
    double modulus_floor_;               ///< [Pa]
    double linear_, quadratic_, cubic_;  ///< E_cold = f (a1 + f (a2 + f a3)) [J/kg]
};

}  // namespace taylorcal::material
