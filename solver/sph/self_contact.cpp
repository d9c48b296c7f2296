#include "solver/sph/self_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Core>

namespace taylorcal::sph {

namespace {

// In local edges: of an element across its surface, in the reference state. With half an
// edge the elements of a coarse skirt leave holes.
constexpr double half_width = 0.75;
constexpr double search_margin = 0.4;
// Of two surfaces that touch. Those that single particles extrapolate scatter about the
// one that they share: with none, the outermost hold the others apart, and heads come out
// too long; with 0.2 they come out too short, with 0.3 a coarse skirt passes the
// shoulder.
constexpr double overlap = 0.1;
// Cosine between the normals of two surfaces from which on they face each other. The
// sides of a fold that has just begun, or of a corner, are joined by the continuum.
constexpr double facing = -0.5;
constexpr double nearly_facing = -0.2;

Eigen::Vector3d offset(const std::array<std::vector<double>, 3>& points, std::size_t i,
                       std::size_t j) {
    return {points[0][j] - points[0][i], points[1][j] - points[1][i],
            points[2][j] - points[2][i]};
}

/// How two elements stand to each other that face each other.
struct Stand {
    Eigen::Vector3d normal;  // from the one to the other
    double gap;              // until their surfaces touch [m]
    double across;           // distance along the surfaces [m]
    double aside;            // the same in lattice cells, the lesser of the two's
};

/// For elements whose local edge is `edge` on an average; nothing if they do not face
/// each other.
std::optional<Stand> stand(const DeformedElement& a, const DeformedElement& b,
                           const Eigen::Vector3d& line, double edge, double cosine) {
    if (a.normal.dot(b.normal) > cosine) return std::nullopt;
    const Eigen::Vector3d normal = (a.normal - b.normal).normalized();
    const double along = line.dot(normal);
    if (along <= 0) return std::nullopt;
    const Eigen::Vector3d across = line - along * normal;
    return Stand{normal, along - a.depth - b.depth + overlap * edge, across.norm(),
                 std::min((a.inverse * across).norm(), (b.inverse * across).norm())};
}

}  // namespace

SelfContact::SelfContact(const specimen::Shape& shape, const Packing& packing,
                         double density)
    : packing_(packing),
      density_(density),
      surface_(surface_elements(shape, packing)),
      narrowest_(packing.edge) {
    for (const SurfaceElement& element : surface_)
        narrowest_ = std::min(narrowest_, packing_.local_edge[element.slot]);
}

double SelfContact::mean_edge(std::size_t i, std::size_t j) const {
    return (packing_.local_edge[i] + packing_.local_edge[j]) / 2;
}

void SelfContact::find_pairs(const Particles& particles) {
    const std::array<std::vector<double>, 3>& x = particles.position;
    std::vector<DeformedElement> deformed;
    double widest =
        0;  // reach of an element, with what it may move until the next search
    for (const SurfaceElement& element : surface_) {
        deformed.push_back(deform(element, packing_, particles));
        double squares = 0;
        for (const auto& component : particles.deformation)
            squares += component[element.slot] * component[element.slot];
        widest = std::max(widest, packing_.local_edge[element.slot] *
                                      (half_width * std::sqrt(squares) + search_margin));
    }
    using Cell = std::array<long, 3>;
    const auto cell_of = [&](std::size_t slot) {
        return Cell{std::lround(x[0][slot] / widest), std::lround(x[1][slot] / widest),
                    std::lround(x[2][slot] / widest)};
    };
    std::vector<std::pair<Cell, std::size_t>> sorted;
    sorted.reserve(surface_.size());
    for (std::size_t e = 0; e < surface_.size(); ++e)
        sorted.emplace_back(cell_of(surface_[e].slot), e);
    std::sort(sorted.begin(), sorted.end());

    near_.clear();
    facing_.clear();
    pairs_.clear();
    std::vector<std::size_t> place(surface_.size(), surface_.size());  // in near_
    const auto place_of = [&](std::size_t e) {
        if (place[e] == surface_.size()) {
            place[e] = near_.size();
            near_.push_back(surface_[e]);
        }
        return place[e];
    };
    const auto visit = [&](std::size_t a, std::size_t b) {
        if (b <= a) return;
        const std::size_t i = surface_[a].slot, j = surface_[b].slot;
        const double edge = mean_edge(i, j);
        const auto stands =
            stand(deformed[a], deformed[b], offset(x, i, j), edge, nearly_facing);
        if (!stands || stands->gap > search_margin * edge ||
            stands->aside > half_width + search_margin)
            return;
        facing_.emplace_back(place_of(a), place_of(b));
        pairs_.emplace_back(i, j);
    };
    for (const auto& [cell, element] : sorted) {
        for (long dx = -1; dx <= 1; ++dx) {
            for (long dy = -1; dy <= 1; ++dy) {
                // The three cells along z are consecutive in the sorted list.
                const Cell low{cell[0] + dx, cell[1] + dy, cell[2] - 1};
                const Cell high{cell[0] + dx, cell[1] + dy, cell[2] + 1};
                auto it = std::lower_bound(sorted.begin(), sorted.end(),
                                           std::pair<Cell, std::size_t>{low, 0});
                for (; it != sorted.end() && it->first <= high; ++it) {
                    visit(element, it->second);
                }
            }
        }
    }
}

const SlotPairs& SelfContact::approaching(const Particles& particles, double duration) {
    double fastest = 0;
    for (const SurfaceElement& element : surface_) {
        const double speed = std::hypot(particles.velocity[0][element.slot],
                                        particles.velocity[1][element.slot],
                                        particles.velocity[2][element.slot]);
        fastest = std::max(fastest, speed);
    }
    allowance_ -= 2 * fastest * duration;
    if (allowance_ <= 0) {
        find_pairs(particles);
        allowance_ = search_margin * narrowest_ - 2 * fastest * duration;
    }
    return pairs_;
}

void SelfContact::find_meetings(const Particles& particles, const Schedule& schedule,
                                int level) {
    deformed_.resize(near_.size());
    nearest_.assign(near_.size(), INFINITY);
    for (std::size_t e = 0; e < near_.size(); ++e) {
        if (schedule.motion_level(near_[e].slot) == level)
            deformed_[e] = deform(near_[e], packing_, particles);
    }
    meetings_.clear();
    for (const auto& [a, b] : facing_) {
        const std::size_t i = near_[a].slot, j = near_[b].slot;
        if (schedule.motion_level(i) != level) continue;
        const auto stands =
            stand(deformed_[a], deformed_[b], offset(particles.position, i, j),
                  mean_edge(i, j), facing);
        if (!stands || stands->aside > half_width) continue;
        meetings_.push_back({a, b, stands->normal, stands->gap, stands->across});
        nearest_[a] = std::min(nearest_[a], stands->across);
        nearest_[b] = std::min(nearest_[b], stands->across);
    }
}

void SelfContact::separate(Particles& particles, const Schedule& schedule, int level) {
    const double dt = schedule.step(level);
    find_meetings(particles, schedule, level);
    for (const Meeting& met : meetings_) {
        if (met.across > nearest_[met.one] && met.across > nearest_[met.other]) continue;
        const std::size_t i = near_[met.one].slot, j = near_[met.other].slot;
        const double closing = -offset(particles.velocity, i, j).dot(met.normal);
        const double left = std::max(met.gap, 0.0) / dt;  // until they touch
        if (closing <= left) continue;
        const double mass_i = density_ * packing_.volume[i];
        const double mass_j = density_ * packing_.volume[j];
        const double impulse = (closing - left) * mass_i * mass_j / (mass_i + mass_j);
        // As for the anvil: the mean closing speed of the whole kick does the work.
        double pulled = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const float* acceleration = particles.acceleration[c].lanes();
            pulled += dt * met.normal(static_cast<Eigen::Index>(c)) *
                      static_cast<double>(acceleration[i] - acceleration[j]);
        }
        lost_energy_ += 0.5 * impulse * (closing - pulled + left);
        for (std::size_t c = 0; c < 3; ++c) {
            const double along = met.normal(static_cast<Eigen::Index>(c));
            particles.velocity[c][i] -= impulse / mass_i * along;
            particles.velocity[c][j] += impulse / mass_j * along;
        }
    }
}

}  // namespace taylorcal::sph
