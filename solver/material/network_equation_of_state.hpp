#pragma once

#include "solver/material/equation_of_state.hpp"
#include "solver/material/thermo_table.hpp"

#include <string>

namespace taylorcal::material {

/// A network that was trained on molecular dynamics of copper (see
/// experiments/equation_of_state), read into a table.
///
/// Potentials miss the density of the metal by a per cent or so. All densities, pressures
/// and moduli are therefore multiplied by initial_density over the network's density of
/// zero pressure at reference_temperature, which is a lattice of slightly other length
/// with the same energies, temperatures and sound speeds; the zero of the energy is moved
/// to that state. specific_heat and bulk_modulus are the network's own.
class NetworkEquationOfState final : public EquationOfState {
  public:
    /// `table` must outlive this. NumericalError if the metal has no density of zero
    /// pressure at the reference temperature.
    NetworkEquationOfState(const ThermoTable& table, const Parameters& parameters);

    ThermoState at(double density, double energy) const override;
    double energy_at_temperature(double temperature) const override;
    double density_at_temperature(double temperature) const override;

  private:
    /// The table's own density of zero pressure.
    double resting_density(double temperature) const;

    const ThermoTable& table_;
    double scale_ = 1;
    double zero_of_energy_ = 0;  ///< [J/kg]
};

/// The table of the committed network of copper, made at the first call.
const ThermoTable& copper_md_table();

/// SHA-256 of the committed network's text.
std::string copper_md_digest();

}  // namespace taylorcal::material
