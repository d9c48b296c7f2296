#include "solver/sph/anvil.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace taylorcal::sph {

Anvil::Anvil(const Packing& packing, double density, const impact::Additions& additions)
    : packing_(packing),
      density_(density),
      plain_(additions.friction_coefficient == 0 && additions.anvil_compliance == 0 &&
             additions.anvil_tilt == 0),
      friction_(additions.friction_coefficient),
      compliance_(additions.anvil_compliance),
      normal_(std::sin(additions.anvil_tilt), 0, std::cos(additions.anvil_tilt)) {
    if (plain_) return;
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        if (packing.volume[slot] <= 0) continue;
        const Eigen::Vector3d place(packing.x[slot], packing.y[slot], packing.z[slot]);
        level_ = std::min(level_, normal_.dot(place));
    }
    if (compliance_ == 0) return;
    face_.assign(packing.slots, 0.0);
    initial_area_.assign(packing.slots, 0.0);
    for (std::size_t c = 0; c < packing.columns.size(); ++c) {
        for (std::size_t k = 0; k < packing.sites_per_column; ++k) {
            const std::size_t slot = packing.columns[c].first_slot + k;
            if (packing.volume[slot] <= 0) continue;
            const Layer& layer = packing.layers[packing.layer_of(c, k)];
            initial_area_[slot] = packing.volume[slot] / (layer.high - layer.low);
        }
    }
}

void Anvil::stop(Particles& particles, std::size_t block, double dt) {
    if (!plain_) {
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t slot = block * block_size + k;
            if (packing_.volume[slot] > 0) stop_on_face(particles, slot, dt);
        }
        return;
    }
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

void Anvil::stop_on_face(Particles& particles, std::size_t slot, double dt) {
    Eigen::Vector3d place, velocity, start;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto i = static_cast<Eigen::Index>(c);
        place(i) = particles.position[c][slot];
        velocity(i) = particles.velocity[c][slot];
        start(i) = velocity(i) -
                   dt * static_cast<double>(particles.acceleration[c].lanes()[slot]);
    }
    const double face = level_ + (face_.empty() ? 0 : face_[slot]);
    const double reach = (face - normal_.dot(place)) / dt;
    const double approach = normal_.dot(velocity);
    if (approach >= reach) return;
    const double mass = density_ * packing_.volume[slot];
    // The step ends on the face, which recedes by compliance x impulse / area.
    double after = reach;
    if (!face_.empty()) {
        const double yielding = compliance_ * mass / (area(particles, slot) * dt);
        after = (reach + yielding * approach) / (1 + yielding);
        face_[slot] -= yielding * (after - approach) * dt;
    }
    Eigen::Vector3d change = (after - approach) * normal_;
    const Eigen::Vector3d sliding = velocity - approach * normal_;
    if (const double speed = sliding.norm(); speed > 0)
        change -= std::min(1.0, friction_ * (after - approach) / speed) * sliding;
    impulse_ += mass * change.z();
    lost_energy_ -= 0.5 * mass * change.dot(start + velocity + change);
    for (std::size_t c = 0; c < 3; ++c)
        particles.velocity[c][slot] += change(static_cast<Eigen::Index>(c));
}

/// Across the axis in the undeformed specimen, as it is now.
double Anvil::area(const Particles& particles, std::size_t slot) const {
    const auto column = [&](std::size_t j) {
        const auto& f = particles.deformation;
        return Eigen::Vector3d(f[j][slot], f[3 + j][slot], f[6 + j][slot]);
    };
    return initial_area_[slot] * column(0).cross(column(1)).norm();
}

}  // namespace taylorcal::sph
