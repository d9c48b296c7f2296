#include "solver/axisymmetric/self_contact.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::axisymmetric {
namespace {

// A node and a segment closer than this along the undeformed outline, in mean segment
// lengths, may lie around an edge from each other: the node is behind the segment without
// touching it, so only one that passes through it from outside is stopped.
constexpr double edge_segments = 2.5;
// Of a segment's length: a node that is less far in front of its line lies on it.
constexpr double in_line = 1e-6;
constexpr double reach_segments = 1.5;

}  // namespace

SelfContact::SelfContact(const Body& body) {
    const auto& outline = body.mesh.outline;
    for (const std::size_t n : outline) {
        reference_radius_.push_back(body.radius[n]);
        reference_height_.push_back(body.height[n]);
    }
    reference_arc_.assign(outline.size(), 0.0);
    for (std::size_t i = 1; i < outline.size(); ++i) {
        reference_arc_[i] = reference_arc_[i - 1] +
                            std::hypot(reference_radius_[i] - reference_radius_[i - 1],
                                       reference_height_[i] - reference_height_[i - 1]);
    }
    reach_ = reach_segments * reference_arc_.back() /
             static_cast<double>(std::max<std::size_t>(1, outline.size() - 1));
}

bool SelfContact::lies_behind(std::size_t node, std::size_t segment) const {
    const double apart = edge_segments / reach_segments * reach_;
    const double arc = reference_arc_[node];
    if (arc <= reference_arc_[segment] - apart ||
        arc >= reference_arc_[segment + 1] + apart)
        return false;
    const double edge_r = reference_radius_[segment + 1] - reference_radius_[segment];
    const double edge_z = reference_height_[segment + 1] - reference_height_[segment];
    const double in_front =  // times the segment's length
        (reference_radius_[node] - reference_radius_[segment]) * edge_z -
        (reference_height_[node] - reference_height_[segment]) * edge_r;
    return in_front <= in_line * (edge_r * edge_r + edge_z * edge_z);
}

void SelfContact::search(const Body& body) {
    const auto& outline = body.mesh.outline;
    watched_.clear();
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const double r = body.radius[outline[i]];
        const double z = body.height[outline[i]];
        for (std::size_t j = 0; j + 1 < outline.size(); ++j) {
            if (i == j || i == j + 1) continue;
            const double r0 = body.radius[outline[j]], r1 = body.radius[outline[j + 1]];
            const double z0 = body.height[outline[j]], z1 = body.height[outline[j + 1]];
            const double gap_r =
                std::max({std::min(r0, r1) - r, r - std::max(r0, r1), 0.0});
            const double gap_z =
                std::max({std::min(z0, z1) - z, z - std::max(z0, z1), 0.0});
            if (gap_r < reach_ && gap_z < reach_)
                watched_.push_back({i, j, lies_behind(i, j)});
        }
    }
    travel_ = 0;
    searched_ = true;
}

void SelfContact::apply(Body& body, double time_step) {
    const auto& outline = body.mesh.outline;
    double fastest_square = 0;
    for (const std::size_t n : outline) {
        fastest_square =
            std::max(fastest_square, body.radial_velocity[n] * body.radial_velocity[n] +
                                         body.axial_velocity[n] * body.axial_velocity[n]);
    }
    travel_ += std::sqrt(fastest_square) * time_step;
    if (!searched_ || travel_ > reach_ / 4) search(body);

    for (const Pair& pair : watched_) {
        const std::size_t n = outline[pair.node];
        const std::size_t a = outline[pair.segment];
        const std::size_t b = outline[pair.segment + 1];
        const double edge_r = body.radius[b] - body.radius[a];
        const double edge_z = body.height[b] - body.height[a];
        const double square = edge_r * edge_r + edge_z * edge_z;
        const double from_r = body.radius[n] - body.radius[a];
        const double from_z = body.height[n] - body.height[a];
        const double share = (from_r * edge_r + from_z * edge_z) / square;
        if (share < 0 || share > 1) continue;
        // The outline runs from foot to rear with the metal on its left.
        const double length = std::sqrt(square);
        const double normal_r = edge_z / length;
        const double normal_z = -edge_r / length;
        const double gap = from_r * normal_r + from_z * normal_z;
        if (gap < (pair.behind ? 0 : -reach_)) continue;
        const double closing =
            (body.radial_velocity[n] - (1 - share) * body.radial_velocity[a] -
             share * body.radial_velocity[b]) *
                normal_r +
            (body.axial_velocity[n] - (1 - share) * body.axial_velocity[a] -
             share * body.axial_velocity[b]) *
                normal_z;
        if (closing >= 0 || gap + closing * time_step >= 0) continue;
        touching_.insert(touching_.end(), {n, a, b});
        const double wanted = gap > 0 ? -gap / time_step : 0.0;
        const double inverse_mass = 1 / body.node_mass[n] +
                                    (1 - share) * (1 - share) / body.node_mass[a] +
                                    share * share / body.node_mass[b];
        const double impulse = (wanted - closing) / inverse_mass;
        body.radial_velocity[n] += impulse * normal_r / body.node_mass[n];
        body.axial_velocity[n] += impulse * normal_z / body.node_mass[n];
        body.radial_velocity[a] -= impulse * (1 - share) * normal_r / body.node_mass[a];
        body.axial_velocity[a] -= impulse * (1 - share) * normal_z / body.node_mass[a];
        body.radial_velocity[b] -= impulse * share * normal_r / body.node_mass[b];
        body.axial_velocity[b] -= impulse * share * normal_z / body.node_mass[b];
        // Work of the impulse beside those of the cells.
        const double pushed =
            normal_r * (body.radial_impulse[n] / body.node_mass[n] -
                        (1 - share) * body.radial_impulse[a] / body.node_mass[a] -
                        share * body.radial_impulse[b] / body.node_mass[b]) +
            normal_z * (body.axial_impulse[n] / body.node_mass[n] -
                        (1 - share) * body.axial_impulse[a] / body.node_mass[a] -
                        share * body.axial_impulse[b] / body.node_mass[b]);
        body.balance.contact -= impulse * (closing - pushed + wanted) / 2;
    }
}

}  // namespace taylorcal::axisymmetric
