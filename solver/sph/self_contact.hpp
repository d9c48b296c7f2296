#pragma once

#include "solver/sph/surface.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace taylorcal::sph {

/// Keeps parts of the surface apart that fold onto each other. Two of its elements that
/// face each other, one above the other, whose surfaces have met give up their approach
/// along their common normal: an inelastic, frictionless collision that conserves
/// momentum and has no stiffness to choose. Surfaces turn and thin as their particles
/// deform (Nanson's relation), so that they meet where the outline shows them to. Their
/// planes reach beyond what bulges, so each meets the one most nearly opposite: a
/// shoulder that rested on all of them would squash the head.
class SelfContact {
  public:
    SelfContact(const specimen::Shape& shape, const Packing& packing, double density);

    /// Finds the pairs of slots that may meet within a time [s].
    const SlotPairs& approaching(const Particles& particles, double duration);
    /// Corrects the velocities with which the pairs of a level are about to move for its
    /// step, for which the accelerations have acted on them.
    void separate(Particles& particles, const Schedule& schedule, int level);

    double lost_energy() const { return lost_energy_; }  ///< kinetic [J]

  private:
    struct Meeting {
        std::size_t one, other;  // elements, of near_
        Eigen::Vector3d normal;  // from the one to the other
        double gap;              // until their surfaces touch [m]
        double across;           // distance along the surfaces [m]
    };
    void find_pairs(const Particles& particles);
    void find_meetings(const Particles& particles, const Schedule& schedule, int level);
    double mean_edge(std::size_t i, std::size_t j) const;  // local, of two slots [m]

    const Packing& packing_;
    double density_;
    std::vector<SurfaceElement> surface_;
    double narrowest_;                  // local edge at the surface [m]
    std::vector<SurfaceElement> near_;  // those that face another one nearby
    std::vector<DeformedElement> deformed_;
    std::vector<std::pair<std::size_t, std::size_t>> facing_;  // pairs of near_
    SlotPairs pairs_;                                          // their slots
    std::vector<Meeting> meetings_;                            // of a level, now
    std::vector<double> nearest_;  // `across` of every near element's meetings, the least
    double allowance_ = 0;  // way that two particles may still close before a new search
    double lost_energy_ = 0;
};

}  // namespace taylorcal::sph
