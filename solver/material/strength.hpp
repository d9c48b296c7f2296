#pragma once

#include "common/lanes.hpp"
#include "solver/material/grain_hooks.hpp"
#include "solver/material/parameters.hpp"

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::material {

// Blocks of grains are filled and read with these.
using taylorcal::broadcast;
using taylorcal::lane_count;
using taylorcal::Lanes;

/// What moves a block of grains during one step, lane by lane.
template <class Real>
struct BlockInput {
    Lanes<Real> velocity_gradient[9];  ///< L_ij = dv_i/dx_j at mid step, row-major [1/s]
    Lanes<Real> density;               ///< at the end of the step [kg/m3]
    Lanes<Real> temperature;           ///< [K]
    Lanes<Real> shear_modulus;         ///< [Pa]
    Real time_step;                    ///< [s]
};

/// What the block answers.
template <class Real>
struct BlockOutput {
    Lanes<Real> stress_deviator[6];  ///< S at the end: xx yy zz xy xz yz, lab frame [Pa]
    Lanes<Real> plastic_power;       ///< S : wdot, mean over the step [W/m3]
    Lanes<Real> plastic_rate;        ///< sqrt(2/3 wdot : wdot) [1/s]
};

/// The state of one grain, for outputs and tests (not for hot loops). SI units.
struct GrainState {
    double equivalent_plastic_strain = 0;  ///< wM = sqrt(2/3 w : w)
    double slip_resistance_Pa = 0;         ///< Ys, or the yield stress of a J2 material
    double mobile_density_m2 = 0;          ///< sum over the slip systems
    double immobile_density_m2 = 0;        ///< sum over the slip systems
    double annihilated_energy_J_m3 = 0;    ///< J
    double grain_diameter_m = 0;           ///< Eq. 22
    double weakened_fraction = 0;          ///< Eq. 24
    double elastic_shear_energy_J_m3 = 0;  ///< S : S / (4 G)
};

/// The deviatoric response of many grains, stored by blocks of `lane_count` lanes. One
/// virtual call moves a block. Blocks are independent of each other.
template <class Real>
class Strength {
  public:
    virtual ~Strength() = default;
    virtual void update(std::size_t block, const BlockInput<Real>& input,
                        BlockOutput<Real>& output) = 0;
    virtual GrainState state(std::size_t grain) const = 0;
    /// Changes the model before the first step; models without dislocations ignore it.
    virtual void change(const GrainChanges&) {}
};

/// Makes the strength model that `parameters.strength` names for `orientations.size()`
/// grains; orientation maps the crystal frame to the lab frame (read by the dislocation
/// model only). The last block is padded.
template <class Real>
std::unique_ptr<Strength<Real>> make_strength(
    const Parameters& parameters, const std::vector<Eigen::Quaterniond>& orientations);

}  // namespace taylorcal::material
