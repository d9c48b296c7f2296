#pragma once

#include "solver/material/equation_of_state.hpp"
#include "solver/material/strength.hpp"
#include "solver/plate/plate_case.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace taylorcal::plate {

/// Flyer and target as one row of cells along x; the flyer's nodes come first, and its
/// last lies on the target's first. Velocities are at mid step. SI units, per unit area.
class Column {
  public:
    explicit Column(const PlateCase& plate_case);

    /// The largest stable step [s].
    double stable_step() const;
    /// Velocities from the stresses over `interval`, then the contact.
    void accelerate(double interval);
    /// Positions, density, stress and energy over `step`; an empty text, or what broke.
    std::string advance(double step);

    std::size_t flyer_nodes() const { return flyer_cells_ + 1; }
    const std::vector<double>& velocity() const { return velocity_; }
    /// Axial stress, tension positive, without artificial viscosity [Pa].
    double stress(std::size_t cell) const {
        return deviator_[cell] - thermo_[cell].pressure;
    }
    std::size_t cells() const { return density_.size(); }
    std::size_t flyer_cells() const { return flyer_cells_; }
    double temperature(std::size_t cell) const { return thermo_[cell].temperature; }
    double kinetic_energy() const;   ///< [J/m2]
    double internal_energy() const;  ///< gained since the start [J/m2]

  private:
    std::size_t left_node(std::size_t cell) const {
        return cell < flyer_cells_ ? cell : cell + 1;
    }
    double join_plates();

    std::size_t flyer_cells_;
    material::Parameters parameters_;
    std::unique_ptr<material::EquationOfState> equation_of_state_;
    std::unique_ptr<material::Strength<float>> strength_;
    std::vector<double> position_, velocity_, node_mass_;  ///< of the nodes
    std::vector<double> cell_mass_, density_, energy_;     ///< of the cells
    std::vector<double> deviator_;                         ///< Sxx [Pa]
    std::vector<double> viscous_pressure_;                 ///< q [Pa]
    std::vector<material::ThermoState> thermo_;
    double gained_ = 0;
};

}  // namespace taylorcal::plate
