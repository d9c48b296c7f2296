#pragma once

#include "solver/impact/impact_case.hpp"
#include "solver/sph/anvil.hpp"
#include "solver/sph/constitutive.hpp"
#include "solver/sph/self_contact.hpp"

#include <functional>
#include <memory>

namespace taylorcal::sph {

/// Makes the strength of a number of grains; tests hand in one that they know.
using StrengthFactory = std::function<std::unique_ptr<material::Strength<float>>(
    const material::Parameters&, const std::vector<Eigen::Quaterniond>&)>;

/// A specimen of particles above the anvil, and its motion by leapfrog steps: velocities
/// live at mid step, positions and stresses at the steps.
class Body {
  public:
    Body(const impact::ImpactCase& impact_case, const StrengthFactory& make_strength);
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    /// Gives every particle the velocity that `field(x, y, z)` has at its reference
    /// place.
    void set_velocity(
        const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& field);
    void step();

    /// Time step that the next `step` takes unless it is shortened [s].
    double time_step() const { return next_step_; }
    void shorten_step(double longest) { next_step_ = std::min(next_step_, longest); }

    double time() const { return time_; }
    const Packing& packing() const { return packing_; }
    const Particles& particles() const { return particles_; }
    const Constitutive& constitutive() const { return constitutive_; }
    const Anvil& anvil() const { return anvil_; }
    const StepReport& report() const { return report_; }
    double mass(std::size_t slot) const { return rest_.density * packing_.volume[slot]; }
    double shear_modulus(std::size_t slot) const;
    double kinetic_energy() const;
    /// Kinetic, internal and stored energy, and what contact took away [J].
    double total_energy() const;

  private:
    void move(double dt);

    Packing packing_;
    std::unique_ptr<material::EquationOfState> equation_of_state_;
    Rest rest_;
    double shear_ratio_;  // G/K
    double courant_;      // step over the least sound time of an edge
    Particles particles_;
    Reference reference_;
    Constitutive constitutive_;
    Anvil anvil_;
    SelfContact self_contact_;
    StepReport report_;
    double time_ = 0;
    double last_step_ = 0;
    double next_step_ = 0;
};

}  // namespace taylorcal::sph
