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

    /// Finds the pairs of slots that may meet within a time [s].
    const SlotPairs& approaching(const Particles& particles, double duration);
    /// Corrects the velocities with which the pairs of a level are about to move for its
    /// step, for which the accelerations have acted on them.
    void separate(Particles& particles, const Schedule& schedule, int level);

    double lost_energy() const { return lost_energy_; }  ///< kinetic [J]

  private:
    void find_surface();
    void find_pairs(const Particles& particles);
    double mean_edge(std::size_t i, std::size_t j) const;  // local, of two slots [m]

    const Packing& packing_;
    double density_;
    std::vector<std::size_t> surface_;  // slots
    double narrowest_;                  // local edge at the surface [m]
    SlotPairs pairs_;                   // that may meet soon
    double allowance_ = 0;  // way that two particles may still close before a new search
    double lost_energy_ = 0;
};

}  // namespace taylorcal::sph
