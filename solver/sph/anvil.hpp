#pragma once

#include "solver/sph/packing.hpp"
#include "solver/sph/particles.hpp"

namespace taylorcal::sph {

/// The rigid, frictionless plane. Particles that would pass it keep on it: their axial
/// velocity is corrected, nothing else, and nothing pulls.
class Anvil {
  public:
    Anvil(const Packing& packing, double density);

    /// Corrects the velocities with which a block is about to move for `dt`, for which
    /// the accelerations have acted on it. [s]
    void stop(Particles& particles, std::size_t block, double dt);

    double impulse() const { return impulse_; }  ///< given to the specimen, upwards [N s]
    double lost_energy() const { return lost_energy_; }  ///< kinetic [J]

  private:
    const Packing& packing_;
    double density_;
    double impulse_ = 0;
    double lost_energy_ = 0;
};

}  // namespace taylorcal::sph
