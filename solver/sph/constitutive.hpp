#pragma once

#include "solver/impact/impact_case.hpp"
#include "solver/material/equation_of_state.hpp"
#include "solver/material/strength.hpp"
#include "solver/sph/grain_step.hpp"
#include "solver/sph/hourglass.hpp"
#include "solver/sph/reference.hpp"

#include <memory>

namespace taylorcal::sph {

/// Work done on the specimen since the start [J].
struct Work {
    double stored_in_shear = 0;  ///< S : D less the share of plastic work turned to heat
    double plastic = 0;
    double viscous = 0;    ///< of the artificial viscosity
    double hourglass = 0;  ///< of the hourglass control
};

/// The undeformed metal at zero pressure.
struct Rest {
    double density;  ///< [kg/m3]
    double energy;   ///< [J/kg]
    material::ThermoState state;
};
Rest rest_state(const material::EquationOfState& equation_of_state, double temperature);

/// From the rates of deformation to stresses: deformation, density, strength, energy,
/// equation of state, artificial viscosity, and first Piola-Kirchhoff stress.
class Constitutive {
  public:
    Constitutive(const impact::ImpactCase& impact_case, const Packing& packing,
                 const material::EquationOfState& equation_of_state, const Rest& rest,
                 std::unique_ptr<material::Strength<float>> strength);

    /// Puts every particle into the undeformed state; returns the least sound time over a
    /// local edge, by active block [s].
    std::vector<double> initialise(Particles& particles) const;
    /// Advances a block by `dt` at its rates dF/dt; `index` counts within
    /// Packing::active. Returns the least sound time over a squeezed edge [s], or zero
    /// when the block is tangled and was not advanced: a particle's volume or its strain
    /// within the step is out of all reason, or not a number.
    double update(Particles& particles, const Reference& reference, std::size_t index,
                  double dt);

    const Work& work() const { return work_; }
    /// Mean state of a particle's grains; `index` counts within Packing::active.
    material::GrainState state(std::size_t index, std::size_t lane) const;

  private:
    template <class Vector>
    double advance(Particles& particles, const Reference& reference, std::size_t index,
                   double dt);
    /// The deviator of one block after a step, and the plastic work that its grains tell
    /// of, if they have moved, for all the time since they last did [J/m3].
    template <class Vector>
    struct Response {
        Vector deviator[6];
        Vector plastic_work;
    };
    template <class Vector>
    Response<Vector> respond(std::size_t index, const Particles& particles,
                             const Vector (&gradient)[9], const Vector& density,
                             float step);
    template <class Vector>
    Response<Vector> move_grains(std::size_t index, const Particles& particles,
                                 const Vector& density);
    template <class Vector>
    MisfitResistance<Vector> misfit_resistance(std::size_t index,
                                               const Vector (&deviator)[6],
                                               const Vector& shear_modulus) const;
    template <class Vector>
    void close_energy(Particles& particles, std::size_t block, const Vector& dilatation,
                      const Vector& density, const Vector& heating, double dt) const;

    const Packing& packing_;
    const material::EquationOfState& equation_of_state_;
    std::unique_ptr<material::Strength<float>> strength_;
    std::vector<GrainStep> grain_steps_;  // by active block
    std::size_t grains_;
    Rest rest_;
    double shear_ratio_;  // G/K
    float heated_share_;  // of the plastic work
    float linear_viscosity_;
    float quadratic_viscosity_;
    Field edge_;              // local [m]
    Field misfit_stiffness_;  // kappa / 2 G [m2]
    Work work_;
};

}  // namespace taylorcal::sph
