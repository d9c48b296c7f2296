#include "solver/material/parameters.hpp"

namespace taylorcal::material {
namespace {

const char* const table_1 = "Rodionov 2023, Table 1";
const char* const microstructure = "Rodionov 2023, Eqs. 21-24";
const char* const table_2 = "Rodionov 2023, Table 2 and optimum ii";
const char* const benchmark = "benchmark of the copper bar at 227 m/s";
const char* const johnson_cook = "OFHC copper, Johnson and Cook 1983";

std::vector<ParameterInfo> make_list() {
    using P = Parameters;
    return {
        {"rho_immobile_initial", "rhoI(0)", "1/m2", 1e10, 1e15, true,
         "initial immobilized density, each slip system", table_2,
         &P::rho_immobile_initial},
        {"hardening_coefficient", "AI", "1", 0, 10, true, "Taylor hardening, Eq. 20",
         table_2, &P::hardening_coefficient},
        {"immobilization_velocity", "VI", "m/s", 0, 5, true,
         "rate of immobilization, Eqs. 15-19", table_2, &P::immobilization_velocity},

        {"rho_mobile_initial", "rhoD(0)", "1/m2", 1e6, 1e16, false,
         "initial mobile density, each slip system", table_1, &P::rho_mobile_initial},
        {"rho_mobile_free", "rhoDfree", "1/m2", 0, 1e16, false,
         "mobile density below which none immobilizes", table_1, &P::rho_mobile_free},
        {"burgers_vector", "b", "m", 1e-10, 1e-9, false, "length of the Burgers vector",
         table_1, &P::burgers_vector},
        {"initial_yield_stress", "Ys0", "Pa", 0, 1e9, false,
         "slip resistance without dislocations", table_1, &P::initial_yield_stress},
        {"annihilation_coefficient", "kA", "1", 0, 100, false,
         "rate of annihilation, Eqs. 15-19", table_1, &P::annihilation_coefficient},
        {"drag_constant", "B(0)", "Pa s", 0, 1e-3, false, "phonon drag at 0 K",
         "Rodionov 2023, Eqs. 12-14", &P::drag_constant},
        {"drag_slope", "dB/dT", "Pa s/K", 0, 1e-6, false, "phonon drag by kelvin",
         "Rodionov 2023, Eqs. 12-14", &P::drag_slope},
        {"dislocation_energy", "epsD", "eV", 0.1, 100, false,
         "energy of a dislocation, each Burgers vector of its length",
         "Rodionov 2023, Eqs. 17 and 21", &P::dislocation_energy},
        {"taylor_quinney", "beta", "1", 0, 1, false, "share of plastic work that heats",
         "Rodionov 2023, Eq. 3", &P::taylor_quinney},

        {"initial_grain_diameter", "d0", "m", 1e-8, 1e-2, false,
         "grain diameter before the test", microstructure, &P::initial_grain_diameter},
        {"boundary_energy", "gammaGB", "J/m2", 0.01, 10, false,
         "energy of grain boundaries", microstructure, &P::boundary_energy},
        {"boundary_energy_fraction", "etaGB", "1", 0, 1, false,
         "share of annihilated energy that makes boundaries", microstructure,
         &P::boundary_energy_fraction},
        {"weakened_zone_diameter", "D", "m", 1e-8, 1e-2, false, "size of weakened zones",
         microstructure, &P::weakened_zone_diameter},
        {"stacking_energy", "epsS", "eV", 0.01, 100, false,
         "energy of a defect in weakened zones", microstructure, &P::stacking_energy},
        {"atomic_density", "n0", "1/m3", 1e27, 1e30, false, "atoms by volume",
         microstructure, &P::atomic_density},

        {"initial_density", "rho0", "kg/m3", 1000, 25000, false, "mass density", table_1,
         &P::initial_density},
        {"poisson_ratio", "mu", "1", 0, 0.49, false, "gives G from K, Eq. 26",
         "Rodionov 2023, Eq. 26", &P::poisson_ratio},
        {"bulk_modulus", "K0", "Pa", 1e9, 1e12, false, "of the linear equation of state",
         "copper at 300 K", &P::bulk_modulus},
        {"specific_heat", "cv", "J/kg/K", 10, 5000, false, "at constant volume",
         "copper at 300 K", &P::specific_heat},
        {"reference_temperature", "T0", "K", 1, 2000, false,
         "temperature of zero energy and initial density", table_1,
         &P::reference_temperature},

        {"j2_yield_stress", "sigmaY", "Pa", 0, 1e11, false, "J2: initial yield stress",
         benchmark, &P::j2_yield_stress},
        {"j2_hardening_modulus", "H", "Pa", 0, 1e12, false,
         "J2: slope over plastic strain", benchmark, &P::j2_hardening_modulus},
        {"jc_a", "A", "Pa", 0, 1e10, false, "Johnson-Cook: initial yield stress",
         johnson_cook, &P::jc_a},
        {"jc_b", "B", "Pa", 0, 1e10, false, "Johnson-Cook: hardening", johnson_cook,
         &P::jc_b},
        {"jc_n", "n", "1", 0.01, 2, false, "Johnson-Cook: exponent of strain",
         johnson_cook, &P::jc_n},
        {"jc_c", "C", "1", 0, 1, false, "Johnson-Cook: rate sensitivity", johnson_cook,
         &P::jc_c},
        {"jc_m", "m", "1", 0.1, 10, false, "Johnson-Cook: exponent of temperature",
         johnson_cook, &P::jc_m},
        {"jc_melting_temperature", "Tm", "K", 301, 10000, false,
         "Johnson-Cook: strength is lost", johnson_cook, &P::jc_melting_temperature},
    };
}

}  // namespace

const std::vector<ParameterInfo>& parameter_list() {
    static const std::vector<ParameterInfo> list = make_list();
    return list;
}

}  // namespace taylorcal::material
