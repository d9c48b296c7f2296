#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taylorcal::material {

enum class StrengthModel { dislocation, j2, johnson_cook, elastic };
enum class EquationOfStateModel { copper, linear, copper_md };

/// Every constant of the material, SI units, at its default (MODEL.md's Table 1 and the
/// published optimum ii). Names are those that users write; `symbol` is the paper's.
struct Parameters {
    StrengthModel strength = StrengthModel::dislocation;
    EquationOfStateModel equation_of_state = EquationOfStateModel::copper;

    // Calibrated, Table 2.
    double rho_immobile_initial = 6.3e12;  // rhoI(0) per system [1/m2]
    double hardening_coefficient = 2.8;    // AI
    double immobilization_velocity = 0.4;  // VI [m/s]

    // Dislocations, Table 1.
    double rho_mobile_initial = 1e11;     // rhoD(0) per system [1/m2]
    double rho_mobile_free = 1e11;        // rhoDfree [1/m2]
    double burgers_vector = 0.2556e-9;    // b [m]
    double initial_yield_stress = 30e6;   // Ys0 [Pa]
    double annihilation_coefficient = 5;  // kA
    double drag_constant = 0.45e-5;       // B at 0 K [Pa s]
    double drag_slope = 2.5e-8;           // dB/dT [Pa s/K]
    double dislocation_energy = 8;        // energy of a dislocation [eV/b]
    double taylor_quinney = 0.9;          // beta

    // Microstructure, Eqs. 21-24.
    double initial_grain_diameter = 18e-6;  // d0 [m]
    double boundary_energy = 0.5;           // gammaGB [J/m2]
    double boundary_energy_fraction = 0.5;  // etaGB
    double weakened_zone_diameter = 20e-6;  // D [m]
    double stacking_energy = 4.5;           // epsS [eV]
    double atomic_density = 1e29;           // n0 [1/m3]

    // Elasticity and equation of state.
    double initial_density = 8930;       // rho0 [kg/m3]
    double poisson_ratio = 0.34;         // mu
    double bulk_modulus = 138e9;         // K0 of the linear equation of state [Pa]
    double specific_heat = 385;          // cv [J/kg/K]
    double reference_temperature = 300;  // T0 at which E = 0 [K]

    // Reference strengths: J2 with linear hardening, Johnson-Cook.
    double j2_yield_stress = 400e6;       // [Pa]
    double j2_hardening_modulus = 100e6;  // [Pa]
    double jc_a = 90e6, jc_b = 292e6, jc_n = 0.31, jc_c = 0.025, jc_m = 1.09;
    double jc_melting_temperature = 1356;  // [K]
};

/// One line of `solver parameters`.
struct ParameterInfo {
    std::string name;
    std::string symbol;
    std::string unit;
    double lowest;
    double highest;
    bool calibrated;  ///< one of Table 2's three
    std::string description;
    std::string source;
    double Parameters::*member;
};

/// All of them, in the order above.
const std::vector<ParameterInfo>& parameter_list();

/// The words for the two models, in the order of the enumerations.
const std::vector<std::string>& strength_names();
const std::vector<std::string>& equation_of_state_names();

/// Every name that can be set: "strength", "equation_of_state" and the parameters'.
const std::vector<std::string>& setting_names();

/// Sets one of the two models by its word. InputError with the nearest word when unknown.
void set_model(Parameters& parameters, std::string_view name, std::string_view word);

/// Sets one by name. InputError for an unknown name (with the nearest) or a value out of
/// its range.
void set_parameter(Parameters& parameters, std::string_view name, double value);

/// InputError unless metal that softens with temperature melts above the reference.
void check_melting_temperature(const Parameters& parameters);

/// InputError when constants, each within its range, contradict each other in the chosen
/// strength.
void check_strength(const Parameters& parameters);

}  // namespace taylorcal::material
