#pragma once

#include "solver/sph/schedule.hpp"

#include <array>
#include <vector>

namespace taylorcal::sph {

/// The moving state of all slots. What is integrated over many small steps is kept in
/// double precision (increments below a float's last place would be lost); what pair
/// loops read is in single precision.
struct Particles {
    explicit Particles(std::size_t slots);

    std::array<std::vector<double>, 3> position;     ///< [m]
    std::array<std::vector<double>, 3> velocity;     ///< at mid step [m/s]
    std::array<std::vector<double>, 9> deformation;  ///< F, row-major
    std::vector<double> energy;                      ///< hydrostatic E [J/kg]

    std::array<Field, 3> speed;  ///< the velocity, rounded [m/s]
    /// Its means over the steps of the levels from 1 on, where they are asked for [m/s].
    std::array<std::array<Field, 3>, Schedule::highest_level> mean_speed;
    std::array<Field, 3> acceleration;  ///< [m/s2]
    std::array<Field, 9> rate;          ///< dF/dt at mid step [1/s]
    std::array<Field, 9> pull;         ///< Q: corrected first Piola-Kirchhoff stress [Pa]
    std::array<Field, 3> misfit_rate;  ///< see Reference::velocity_gradient [1/(m s)]
    std::array<Field, 3> elastic_misfit;   ///< u, see resist_misfit() [1/m]
    std::array<Field, 3> misfit_pull;      ///< q [Pa m]
    std::array<Field, 6> stress_deviator;  ///< S: xx yy zz xy xz yz [Pa]
    Field pressure;                        ///< without the artificial one [Pa]
    Field temperature;                     ///< [K]
    Field bulk_modulus;                    ///< [Pa]
    Field density;                         ///< [kg/m3]
};

}  // namespace taylorcal::sph
