#pragma once

#include "solver/impact/additions.hpp"
#include "solver/sph/packing.hpp"
#include "solver/sph/particles.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::sph {

/// The anvil's plane. Particles that would pass it keep on it: their velocity along its
/// normal is corrected, and nothing pulls. As the additions have it, friction takes from
/// the velocity along the plane, the face recedes under pressure from each particle by
/// itself, and the plane is tilted about y so that the specimen's rim at the side -x
/// touches it first.
class Anvil {
  public:
    Anvil(const Packing& packing, double density, const impact::Additions& additions);

    /// Corrects the velocities with which a block is about to move for `dt`, for which
    /// the accelerations have acted on it. [s]
    void stop(Particles& particles, std::size_t block, double dt);

    double impulse() const { return impulse_; }  ///< given to the specimen, upwards [N s]
    double lost_energy() const { return lost_energy_; }  ///< kinetic [J]
    /// How far the face has receded under a slot [m].
    double recession(std::size_t slot) const { return face_.empty() ? 0 : -face_[slot]; }

  private:
    void stop_on_face(Particles& particles, std::size_t slot, double dt);
    double area(const Particles& particles, std::size_t slot) const;

    const Packing& packing_;
    double density_;
    bool plain_;  // rigid, smooth and level
    double friction_;
    double compliance_;  // [m/s/Pa]
    Eigen::Vector3d normal_;
    double level_ = 0;                  // of the face along its normal [m]
    std::vector<double> face_;          // further height under each slot [m]
    std::vector<double> initial_area_;  // of a slot's layer, across the axis [m2]
    double impulse_ = 0;
    double lost_energy_ = 0;
};

}  // namespace taylorcal::sph
