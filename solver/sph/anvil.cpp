#include "solver/sph/anvil.hpp"

namespace taylorcal::sph {

Anvil::Anvil(const Packing& packing, double density)
    : packing_(packing), density_(density) {}

void Anvil::stop(Particles& particles, std::size_t block, double dt) {
    auto& velocity = particles.velocity[2];
    const float* acceleration = particles.acceleration[2].lanes();
    const auto& height = particles.position[2];
    for (std::size_t slot = block * block_size; slot < (block + 1) * block_size; ++slot) {
        if (height[slot] + dt * velocity[slot] >= 0) continue;
        if (packing_.volume[slot] <= 0) continue;
        const double before = velocity[slot];
        const double after = -height[slot] / dt;
        const double mass = density_ * packing_.volume[slot];
        impulse_ += mass * (after - before);
        // The work of a force in leapfrog is its impulse times the mean of the velocities
        // before and after the whole kick, not this correction alone.
        const double start = before - dt * static_cast<double>(acceleration[slot]);
        lost_energy_ -= 0.5 * mass * (after - before) * (start + after);
        velocity[slot] = after;
    }
}

}  // namespace taylorcal::sph
