#pragma once

#include "solver/axisymmetric/anvil.hpp"
#include "solver/axisymmetric/grain_step.hpp"
#include "solver/axisymmetric/mesh.hpp"
#include "solver/axisymmetric/quadrilateral.hpp"
#include "solver/impact/impact_case.hpp"
#include "solver/impact/phase_clock.hpp"
#include "solver/material/equation_of_state.hpp"
#include "solver/material/strength.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace taylorcal::axisymmetric {

/// Where the specimen's energy has gone [J].
struct EnergyBalance {
    double initial_kinetic = 0;
    double internal = 0;      ///< hydrostatic, elastic shear and stored plastic work
    double plastic_work = 0;  ///< part of internal
    double viscous = 0;       ///< artificial viscosity; part of internal
    double hourglass = 0;     ///< hourglass control
    double contact = 0;       ///< nodes stopped by the anvil or by each other
};

/// The state of a specimen in (r, z): nodes carry mass and motion, cells one stress point
/// each with several grains that share its strain. Structure of arrays, SI units.
struct Body {
    Body(const impact::ImpactCase& impact_case);

    std::size_t nodes() const { return radius.size(); }
    std::size_t cells() const { return mesh.cells.size(); }

    Mesh mesh;
    std::vector<double> radius, height;                   ///< of the nodes [m]
    std::vector<double> radial_velocity, axial_velocity;  ///< at mid step [m/s]
    std::vector<double> radial_impulse, axial_impulse;    ///< not yet in them [N s]
    std::vector<double> node_mass;                        ///< [kg]

    std::vector<double> cell_mass;  ///< [kg]
    std::vector<double> cell_step;  ///< own time step [s]
    /// Corners of the cells at their last update, radii and heights [m], and what nodal
    /// forces need of them.
    std::vector<std::array<double, 4>> last_radius, last_height;
    std::vector<Ring> ring;
    std::vector<std::array<double, 4>> hourglass_gamma;  ///< see HourglassModes
    std::vector<double> energy;  ///< E, hydrostatic specific energy [J/kg]
    std::vector<material::ThermoState> thermo;
    std::vector<std::array<double, 4>> deviator;  ///< S: rr, tt, zz, rz [Pa]
    std::vector<double> viscous_pressure;         ///< q [Pa]
    std::vector<double> plastic_rate;             ///< equivalent [1/s]
    std::vector<GrainStep> grain_step;
    std::vector<std::array<double, 2>> hourglass_stress;  ///< of the r and z modes [Pa]
    std::vector<std::array<double, 2>> hourglass_force;   ///< on the modes [N]

    std::unique_ptr<material::EquationOfState> equation_of_state;
    std::unique_ptr<material::Strength<float>> strength;
    material::Parameters parameters;
    impact::Numerics numerics;
    double heated_share;  ///< of the plastic work
    Anvil anvil;
    EnergyBalance balance;
    impact::PhaseClock clock;
    double time = 0;
    double time_step = 0;    ///< shortest of the cells' [s]
    std::int64_t steps = 0;  ///< of the shortest length
    std::int64_t cell_updates = 0;
};

/// Of longitudinal waves in a cell [m/s].
double sound_speed(const Body& body, std::size_t cell);

/// sqrt(3/2 S : S) of a deviator with the components rr, tt, zz, rz.
double von_mises_stress(const std::array<double, 4>& deviator);

}  // namespace taylorcal::axisymmetric
