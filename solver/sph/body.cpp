#include "solver/sph/body.hpp"

#include "solver/sph/orientations.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace taylorcal::sph {

namespace {

// The step is the least sound time over a particle's own squeezed edge, times this and
// the Courant number. The 227 m/s copper bar is stable up to nearly twice the default.
constexpr double edges_per_courant_number = 2;

/// Of rhoI(0), by grains in the order of the strength's blocks; empty if none differs.
/// The mean over eight places within a particle, since a skin may be thinner.
std::vector<double> initial_density_factors(const Packing& packing, std::size_t grains,
                                            const impact::Additions& additions) {
    std::vector<double> factors;
    if (additions.initial_density.empty()) return factors;
    for (const std::size_t block : packing.active) {
        std::array<double, block_size> of_block{};
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t slot = block * block_size + k;
            const double reach = packing.local_edge[slot] / 4;
            for (int corner = 0; corner < 8; ++corner) {
                const double x = packing.x[slot] + (corner & 1 ? reach : -reach);
                const double y = packing.y[slot] + (corner & 2 ? reach : -reach);
                const double z = packing.z[slot] + (corner & 4 ? reach : -reach);
                double factor = 1;
                for (const auto& rule : additions.initial_density)
                    factor *= rule(std::hypot(x, y), z);
                of_block[k] += factor / 8;
            }
        }
        for (std::size_t g = 0; g < grains; ++g)
            factors.insert(factors.end(), of_block.begin(), of_block.end());
    }
    return factors;
}

std::unique_ptr<material::Strength<float>> strength_of(
    const impact::ImpactCase& impact_case, const Packing& packing,
    const StrengthFactory& make_strength) {
    const auto grains = static_cast<std::size_t>(impact_case.numerics.grains_per_point);
    const impact::Additions& additions = impact_case.additions;
    auto strength = make_strength(
        impact_case.material,
        random_orientations(impact_case.seed, packing, grains, additions.orientations));
    strength->change(
        {additions.grains, initial_density_factors(packing, grains, additions)});
    return strength;
}

}  // namespace

Body::Body(const impact::ImpactCase& impact_case, const StrengthFactory& make_strength)
    : packing_(pack(impact_case.shape, impact_case.shape.rear_radius() /
                                           impact_case.numerics.elements_across_radius)),
      equation_of_state_(material::make_equation_of_state(impact_case.material)),
      rest_(rest_state(*equation_of_state_, impact_case.initial_temperature_K)),
      shear_ratio_(material::shear_modulus(1, impact_case.material.poisson_ratio)),
      courant_(packing_.active.size(),
               edges_per_courant_number * impact_case.numerics.cfl),
      particles_(packing_.slots),
      reference_(packing_, rest_.density),
      constitutive_(impact_case, packing_, *equation_of_state_, rest_,
                    strength_of(impact_case, packing_, make_strength)),
      anvil_(packing_, rest_.density, impact_case.additions),
      self_contact_(impact_case.shape, packing_, rest_.density),
      schedule_(packing_, reference_.stencils(packing_)) {
    particles_.position = {packing_.x, packing_.y, packing_.z};
    sound_time_ = constitutive_.initialise(particles_);
    plan();
    for (const std::size_t block : packing_.active) {
        const auto first =
            packing_.volume.begin() + static_cast<long>(block * block_size);
        particles_in_.push_back(static_cast<int>(
            std::count_if(first, first + block_size, [](double v) { return v > 0; })));
    }
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

void Body::limit_steps(const std::function<double(const Eigen::Vector3d&)>& share) {
    for (std::size_t i = 0; i < packing_.active.size(); ++i) {
        double least = 1;
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t slot = packing_.active[i] * block_size + k;
            if (packing_.volume[slot] <= 0) continue;
            least = std::min(
                least, share({packing_.x[slot], packing_.y[slot], packing_.z[slot]}));
        }
        courant_[i] *= least;
    }
    plan();
}

void Body::plan() {
    std::vector<double> stable;
    for (std::size_t i = 0; i < sound_time_.size(); ++i) {
        stable.push_back(courant_[i] * sound_time_[i]);
    }
    schedule_.plan(stable);
}

/// Moves a block for its own step, and adds to its mean velocities.
void Body::drift(std::uint32_t index, std::uint32_t tick, int level) {
    const std::size_t block = packing_.active[index];
    const std::size_t first = block * block_size;
    const double dt = schedule_.step(level);
    for (std::size_t c = 0; c < 3; ++c) {
        const double* velocity = particles_.velocity[c].data();
        double* position = particles_.position[c].data();
        for (std::size_t s = first; s < first + block_size; ++s) {
            position[s] += dt * velocity[s];
        }
        particles_.speed[c][block] = rounded(velocity + first);
    }
    for (std::uint32_t wanted = schedule_.means_wanted(index); wanted != 0;
         wanted &= wanted - 1) {
        const int longer = std::countr_zero(wanted);
        const auto share = static_cast<float>(std::exp2(level - longer));
        auto& mean = particles_.mean_speed[static_cast<std::size_t>(longer - 1)];
        const bool begins = schedule_.open_level(tick) >= longer;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vector part = share * particles_.speed[c][block];
            mean[c][block] = begins ? part : mean[c][block] + part;
        }
    }
}

/// Accelerates and moves the blocks that begin a step of their motion with this tick.
void Body::move(std::uint32_t tick) {
    const int open = schedule_.open_level(tick);
    for (int level = 0; level <= open; ++level) {
        for (const std::uint32_t index : schedule_.moving(level)) {
            const std::size_t block = packing_.active[index];
            if (schedule_.pulled_alike(index, tick)) {
                reference_.accelerate(particles_, block, schedule_.share(index, tick));
            } else {
                reference_.accelerate(particles_, block, schedule_.arrivals(index, tick));
            }
        }
    }
    clock_.mark(impact::Phase::forces);
    for (int level = 0; level <= open; ++level) {
        const double dt = schedule_.step(level);
        for (const std::uint32_t index : schedule_.moving(level)) {
            const std::size_t first = packing_.active[index] * block_size;
            for (std::size_t c = 0; c < 3; ++c) {
                double* velocity = particles_.velocity[c].data();
                const float* acceleration = particles_.acceleration[c].lanes();
                for (std::size_t s = first; s < first + block_size; ++s) {
                    velocity[s] += dt * static_cast<double>(acceleration[s]);
                }
            }
        }
        self_contact_.separate(particles_, schedule_, level);
        for (const std::uint32_t index : schedule_.moving(level)) {
            anvil_.stop(particles_, packing_.active[index], dt);
            drift(index, tick, level);
        }
    }
    clock_.mark(impact::Phase::motion);
}

/// Renews the stresses of the blocks whose step ends before this tick.
void Body::renew_stresses(std::uint32_t tick) {
    const int open = schedule_.open_level(tick);
    for (int level = 0; level <= open; ++level) {
        const double dt = schedule_.step(level);
        for (const std::uint32_t index : schedule_.renewed(level)) {
            const std::size_t block = packing_.active[index];
            const auto& velocity =
                schedule_.moved_alike(index)
                    ? particles_.speed
                    : particles_.mean_speed[static_cast<std::size_t>(level - 1)];
            reference_.velocity_gradient(particles_, block, velocity);
            clock_.mark(impact::Phase::gradients);
            sound_time_[index] = constitutive_.update(particles_, reference_, index, dt);
            tangled_ = tangled_ || !(sound_time_[index] > 0);
            clock_.mark(impact::Phase::plasticity);
            point_updates_ += particles_in_[index];
        }
    }
}

void Body::cycle() {
    clock_.begin_round();
    schedule_.start(self_contact_.approaching(particles_, schedule_.duration()));
    clock_.mark(impact::Phase::motion);
    for (std::uint32_t tick = 0; tick < schedule_.ticks() && !tangled_; ++tick) {
        move(tick);
        renew_stresses(tick + 1);
        time_ += schedule_.tick();
        ++ticks_;
    }
    if (!tangled_) plan();
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
