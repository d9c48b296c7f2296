#include "solver/sph/body.hpp"

#include "solver/sph/orientations.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::sph {

namespace {

constexpr double longest_growth = 1.05;  // of the time step from one step to the next

// The step is the least sound time over a particle's own squeezed edge, times this and
// the Courant number. The 227 m/s copper bar is stable up to nearly twice the default.
constexpr double edges_per_courant_number = 2;
// Hourglass damping in units of density, sound speed and edge, over its coefficient. A
// third and three times the default move lengths by 0.2 % and face diameters by 1 %.
constexpr double damping_per_coefficient = 0.3;

}  // namespace

Body::Body(const impact::ImpactCase& impact_case, const StrengthFactory& make_strength)
    : packing_(pack(impact_case.shape, impact_case.shape.rear_radius() /
                                           impact_case.numerics.elements_across_radius)),
      equation_of_state_(material::make_equation_of_state(impact_case.material)),
      rest_(rest_state(*equation_of_state_, impact_case.initial_temperature_K)),
      shear_ratio_(material::shear_modulus(1, impact_case.material.poisson_ratio)),
      courant_(edges_per_courant_number * impact_case.numerics.cfl),
      particles_(packing_.slots),
      reference_(packing_, rest_.density,
                 damping_per_coefficient * impact_case.numerics.hourglass *
                     rest_.density * packing_.edge *
                     std::sqrt(rest_.state.bulk_modulus / rest_.density)),
      constitutive_(
          impact_case, packing_, *equation_of_state_, rest_,
          make_strength(impact_case.material,
                        random_orientations(impact_case.seed, packing_,
                                            static_cast<std::size_t>(
                                                impact_case.numerics.grains_per_point)))),
      anvil_(packing_, rest_.density),
      self_contact_(packing_, rest_.density) {
    particles_.position = {packing_.x, packing_.y, packing_.z};
    report_ = constitutive_.initialise(particles_);
    next_step_ = courant_ * report_.sound_time;
    const double speed = impact_case.velocity_m_s;
    set_velocity([=](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, -speed); });
}

void Body::set_velocity(
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& field) {
    for (std::size_t slot = 0; slot < packing_.slots; ++slot) {
        if (packing_.volume[slot] <= 0) continue;
        const Eigen::Vector3d v =
            field({packing_.x[slot], packing_.y[slot], packing_.z[slot]});
        for (std::size_t c = 0; c < 3; ++c) {
            particles_.velocity[c][slot] = v(static_cast<Eigen::Index>(c));
            particles_.speed[c].lanes()[slot] =
                static_cast<float>(particles_.velocity[c][slot]);
        }
    }
}

void Body::move(double dt) {
    const double kick = 0.5 * (last_step_ + dt);
    for (std::size_t c = 0; c < 3; ++c) {
        double* velocity = particles_.velocity[c].data();
        const float* acceleration = particles_.acceleration[c].lanes();
        for (const std::size_t block : packing_.active) {
            const std::size_t first = block * block_size;
            for (std::size_t s = first; s < first + block_size; ++s) {
                velocity[s] += kick * static_cast<double>(acceleration[s]);
            }
        }
    }
    self_contact_.separate(particles_, kick, dt);
    anvil_.stop(particles_, kick, dt);
    for (std::size_t c = 0; c < 3; ++c) {
        const double* velocity = particles_.velocity[c].data();
        double* position = particles_.position[c].data();
        for (const std::size_t block : packing_.active) {
            const std::size_t first = block * block_size;
            for (std::size_t s = first; s < first + block_size; ++s) {
                position[s] += dt * velocity[s];
            }
            particles_.speed[c][block] = rounded(velocity + first);
        }
    }
}

void Body::step() {
    const double dt = next_step_;
    reference_.accelerate(particles_);
    move(dt);
    reference_.velocity_gradient(particles_);
    report_ = constitutive_.update(particles_, reference_, dt);
    time_ += dt;
    last_step_ = dt;
    next_step_ = std::min(courant_ * report_.sound_time, longest_growth * dt);
}

double Body::shear_modulus(std::size_t slot) const {
    return shear_ratio_ * static_cast<double>(particles_.bulk_modulus.lanes()[slot]);
}

double Body::kinetic_energy() const {
    double energy = 0;
    for (std::size_t slot = 0; slot < packing_.slots; ++slot) {
        for (const auto& component : particles_.velocity) {
            energy += 0.5 * mass(slot) * component[slot] * component[slot];
        }
    }
    return energy;
}

double Body::total_energy() const {
    double internal = 0;
    for (std::size_t slot = 0; slot < packing_.slots; ++slot) {
        internal += mass(slot) * (particles_.energy[slot] - rest_.energy);
    }
    return kinetic_energy() + internal + constitutive_.work().stored_in_shear +
           anvil_.lost_energy() + self_contact_.lost_energy();
}

}  // namespace taylorcal::sph
