#include "solver/sph/self_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <Eigen/Core>

namespace taylorcal::sph {

namespace {

// In local edges, means of the two. Two surfaces that touch have their particles' planes
// half an edge apart and the particles themselves somewhat more.
constexpr double contact_distance = 0.6;
constexpr double search_margin = 0.4;
// Nearer pairs are joined by the continuum; so are pairs further apart that it has itself
// brought as near as they are.
constexpr double least_reference_distance = 2;

Eigen::Vector3d offset(const std::array<std::vector<double>, 3>& points, std::size_t i,
                       std::size_t j) {
    return {points[0][j] - points[0][i], points[1][j] - points[1][i],
            points[2][j] - points[2][i]};
}

Eigen::Matrix3d mean_deformation(const Particles& particles, std::size_t i,
                                 std::size_t j) {
    Eigen::Matrix3d mean;
    for (std::size_t c = 0; c < 9; ++c) {
        const auto& f = particles.deformation[c];
        mean(static_cast<Eigen::Index>(c / 3), static_cast<Eigen::Index>(c % 3)) =
            (f[i] + f[j]) / 2;
    }
    return mean;
}

}  // namespace

SelfContact::SelfContact(const Packing& packing, double density)
    : packing_(packing), density_(density), narrowest_(packing.edge) {
    find_surface();
}

/// Sites that lack one of the fourteen nearest ones of the bcc lattice.
void SelfContact::find_surface() {
    std::map<std::tuple<int, int, int>, std::size_t> slot_at;
    for (const Column& column : packing_.columns) {
        const std::size_t end = column.first_slot + packing_.sites_per_column;
        for (std::size_t slot = column.first_slot; slot < end; ++slot) {
            if (packing_.volume[slot] <= 0) continue;
            const auto layer =
                2 * static_cast<int>(slot - column.first_slot) + column.parity();
            slot_at[{column.ix, column.iy, layer}] = slot;
        }
    }
    for (const auto& [site, slot] : slot_at) {
        const auto& [x, y, layer] = site;
        bool inside = true;
        for (const int s : {-1, 1}) {
            inside = inside && slot_at.contains({x + 2 * s, y, layer}) &&
                     slot_at.contains({x, y + 2 * s, layer}) &&
                     slot_at.contains({x, y, layer + 2 * s});
            for (const int t : {-1, 1}) {
                for (const int u : {-1, 1}) {
                    inside = inside && slot_at.contains({x + s, y + t, layer + u});
                }
            }
        }
        if (!inside) surface_.push_back(slot);
    }
    for (const std::size_t slot : surface_)
        narrowest_ = std::min(narrowest_, packing_.local_edge[slot]);
}

double SelfContact::mean_edge(std::size_t i, std::size_t j) const {
    return (packing_.local_edge[i] + packing_.local_edge[j]) / 2;
}

void SelfContact::find_pairs(const Particles& particles) {
    const double widest = (contact_distance + search_margin) * packing_.edge;
    const std::array<std::vector<double>, 3>& x = particles.position;
    using Cell = std::array<long, 3>;
    const auto cell_of = [&](std::size_t slot) {
        return Cell{std::lround(x[0][slot] / widest), std::lround(x[1][slot] / widest),
                    std::lround(x[2][slot] / widest)};
    };
    std::vector<std::pair<Cell, std::size_t>> sorted;
    sorted.reserve(surface_.size());
    for (const std::size_t slot : surface_) sorted.emplace_back(cell_of(slot), slot);
    std::sort(sorted.begin(), sorted.end());

    pairs_.clear();
    const auto visit = [&](std::size_t i, std::size_t j) {
        if (j <= i) return;
        const double edge = mean_edge(i, j);
        const double reach = (contact_distance + search_margin) * edge;
        if (offset(x, i, j).norm() > reach) return;
        const Eigen::Vector3d reference(packing_.x[j] - packing_.x[i],
                                        packing_.y[j] - packing_.y[i],
                                        packing_.z[j] - packing_.z[i]);
        if (reference.norm() < least_reference_distance * edge) return;
        const double carried = (mean_deformation(particles, i, j) * reference).norm();
        if (carried > reach) pairs_.emplace_back(i, j);
    };
    for (const auto& [cell, slot] : sorted) {
        for (long dx = -1; dx <= 1; ++dx) {
            for (long dy = -1; dy <= 1; ++dy) {
                // The three cells along z are consecutive in the sorted list.
                const Cell low{cell[0] + dx, cell[1] + dy, cell[2] - 1};
                const Cell high{cell[0] + dx, cell[1] + dy, cell[2] + 1};
                auto it = std::lower_bound(sorted.begin(), sorted.end(),
                                           std::pair<Cell, std::size_t>{low, 0});
                for (; it != sorted.end() && it->first <= high; ++it) {
                    visit(slot, it->second);
                }
            }
        }
    }
}

const SlotPairs& SelfContact::approaching(const Particles& particles, double duration) {
    double fastest = 0;
    for (const std::size_t slot : surface_) {
        const double speed =
            std::hypot(particles.velocity[0][slot], particles.velocity[1][slot],
                       particles.velocity[2][slot]);
        fastest = std::max(fastest, speed);
    }
    allowance_ -= 2 * fastest * duration;
    if (allowance_ <= 0) {
        find_pairs(particles);
        allowance_ = search_margin * narrowest_ - 2 * fastest * duration;
    }
    return pairs_;
}

void SelfContact::separate(Particles& particles, const Schedule& schedule, int level) {
    const double dt = schedule.step(level);
    for (const auto& [i, j] : pairs_) {
        if (schedule.motion_level(i) != level) continue;
        const Eigen::Vector3d line = offset(particles.position, i, j);
        const double distance = line.norm();
        if (distance >= contact_distance * mean_edge(i, j)) continue;
        const Eigen::Vector3d normal = line / distance;
        const double closing = -offset(particles.velocity, i, j).dot(normal);
        if (closing <= 0) continue;
        const double mass_i = density_ * packing_.volume[i];
        const double mass_j = density_ * packing_.volume[j];
        const double impulse = closing * mass_i * mass_j / (mass_i + mass_j);
        // As for the anvil: the mean closing speed of the whole kick does the work.
        double pulled = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const float* acceleration = particles.acceleration[c].lanes();
            pulled += dt * normal(static_cast<Eigen::Index>(c)) *
                      static_cast<double>(acceleration[i] - acceleration[j]);
        }
        lost_energy_ += 0.5 * impulse * (closing - pulled);
        for (std::size_t c = 0; c < 3; ++c) {
            const double along = normal(static_cast<Eigen::Index>(c));
            particles.velocity[c][i] -= impulse / mass_i * along;
            particles.velocity[c][j] += impulse / mass_j * along;
        }
    }
}

}  // namespace taylorcal::sph
