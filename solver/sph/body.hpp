#pragma once

#include "solver/impact/impact_case.hpp"
#include "solver/impact/phase_clock.hpp"
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
/// live at mid step, positions and stresses at the steps. Each block takes its own steps
/// (see Schedule); between cycles all are in step.
class Body {
  public:
    Body(const impact::ImpactCase& impact_case, const StrengthFactory& make_strength);
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    /// Gives every particle the velocity that `field(x, y, z)` has at its reference
    /// place.
    void set_velocity(
        const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& field);
    /// Holds particles to a share of their stable step, by their reference place.
    void limit_steps(const std::function<double(const Eigen::Vector3d&)>& share);
    /// Moves all particles for the same time, each block in as many steps as it needs.
    void cycle();

    /// Holds the next cycle to a time [s].
    void shorten_cycle(double longest) { schedule_.shorten(longest); }

    double time() const { return time_; }
    const Packing& packing() const { return packing_; }
    const Particles& particles() const { return particles_; }
    const Constitutive& constitutive() const { return constitutive_; }
    const Anvil& anvil() const { return anvil_; }
    bool tangled() const { return tangled_; }      ///< the last cycle was not completed
    std::int64_t ticks() const { return ticks_; }  ///< finest steps since the start
    std::int64_t point_updates() const { return point_updates_; }  ///< of stresses
    double mean_neighbours() const { return reference_.mean_neighbours(); }
    const impact::PhaseClock& clock() const { return clock_; }
    double mass(std::size_t slot) const { return rest_.density * packing_.volume[slot]; }
    double shear_modulus(std::size_t slot) const;
    double kinetic_energy() const;
    /// Kinetic, internal and stored energy, and what contact took away [J].
    double total_energy() const;

  private:
    void plan();
    void move(std::uint32_t tick);
    void drift(std::uint32_t index, std::uint32_t tick, int level);
    void renew_stresses(std::uint32_t tick);

    Packing packing_;
    std::unique_ptr<material::EquationOfState> equation_of_state_;
    Rest rest_;
    double shear_ratio_;           // G/K
    std::vector<double> courant_;  // step over the least sound time, by active block
    Particles particles_;
    Reference reference_;
    Constitutive constitutive_;
    Anvil anvil_;
    SelfContact self_contact_;
    Schedule schedule_;
    std::vector<double> sound_time_;  // least over an edge, by active block [s]
    std::vector<int> particles_in_;   // by active block
    bool tangled_ = false;
    double time_ = 0;
    std::int64_t ticks_ = 0;
    std::int64_t point_updates_ = 0;
    impact::PhaseClock clock_;
};

}  // namespace taylorcal::sph
