#pragma once

#include "solver/material/equation_of_state.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace taylorcal::emulator {
class Emulator;
}

namespace taylorcal::material {

/// P, T and K of a network with inputs density_kg_m3, energy_J_kg and outputs
/// pressure_Pa, temperature_K, bulk_modulus_Pa, made into pieces that a solver can ask
/// one state at a time: cubic in the density, and of degree 8 in the energy between those
/// of the coldest and the hottest temperature that the network learnt. SI units.
///
/// Colder and hotter states continue along the tangent in the energy, which is the metal
/// of Mie and Grueneisen, from 0 K to twice the hottest temperature. Beyond these and
/// beyond the network's densities at() throws a NumericalError: nothing is known of such
/// a state.
class ThermoTable {
  public:
    /// InputError if the network has other inputs or outputs.
    ThermoTable(const emulator::Emulator& network, double coldest, double hottest);

    ThermoState at(double density, double energy) const;
    /// The energy [J/kg] of a temperature at one density.
    double energy_at(double density, double temperature) const;
    double lowest_density() const { return lowest_; }
    double highest_density() const { return highest_; }

  private:
    static constexpr std::size_t terms = 9;  // powers of the share of the energy
    static constexpr std::size_t pressure = 2, temperature = pressure + terms,
                                 modulus = temperature + terms, lanes = modulus + terms;
    /// Energy of the coldest state, 1/(hottest - coldest energy), then the coefficients.
    using Lanes = std::array<double, lanes>;
    /// A piece is a cubic of the place in its interval, lane by lane.
    using Piece = std::array<Lanes, 4>;

    std::vector<Lanes> nodes_of(const emulator::Emulator& network) const;
    Lanes lanes_at(double density) const;
    static ThermoState inside(const Lanes& lane, double share);
    ThermoState outside(const Lanes& lane, double share, double density,
                        double energy) const;

    double coldest_, hottest_;  ///< [K]
    double lowest_, highest_;   ///< [kg/m3]
    double spacing_;            ///< of nodes [kg/m3]
    std::vector<Piece> pieces_;
};

}  // namespace taylorcal::material
