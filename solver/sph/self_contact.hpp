#pragma once

#include "solver/sph/packing.hpp"
#include "solver/sph/particles.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace taylorcal::sph {

/// Keeps parts of the surface apart that were apart and fold onto each other. Two surface
/// particles, far from each other in the reference state, that are closer than their
/// half layers allow give up their approach along their line: an inelastic, frictionless
/// collision that conserves momentum and has no stiffness to choose.
class SelfContact {
  public:
    SelfContact(const Packing& packing, double density);

    /// Corrects the velocities with which particles are about to move for `dt`, after the
    /// accelerations have acted on them for `kick`. [s]
    void separate(Particles& particles, double kick, double dt);

    double lost_energy() const { return lost_energy_; }  ///< kinetic [J]

  private:
    void find_surface();
    void find_pairs(const Particles& particles);

    const Packing& packing_;
    double density_;
    std::vector<std::size_t> surface_;                        // slots
    std::vector<std::pair<std::size_t, std::size_t>> pairs_;  // that may meet soon
    double allowance_ = 0;  // way that two particles may still close before a new search
    double lost_energy_ = 0;
};

}  // namespace taylorcal::sph
