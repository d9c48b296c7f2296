#include "solver/axisymmetric/anvil.hpp"

#include "solver/axisymmetric/body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace taylorcal::axisymmetric {

Anvil::Anvil(const Mesh& mesh, const impact::Additions& additions)
    : friction_(additions.friction_coefficient), compliance_(additions.anvil_compliance) {
    if (compliance_ == 0) return;
    surface_ = mesh.foot;
    surface_.insert(surface_.end(), mesh.outline.begin() + 1, mesh.outline.end());
    place_.assign(mesh.node_radius.size(), nowhere);
    for (std::size_t i = 0; i < surface_.size(); ++i) place_[surface_[i]] = i;
    face_.assign(mesh.node_radius.size(), 0.0);
}

/// Half of the rings to both neighbours on the surface; none for a node inside [m2].
double Anvil::surface_area(const Body& body, std::size_t node) const {
    const std::size_t place = place_[node];
    if (place == nowhere) return 0;
    const double r = body.radius[node];
    const auto half_ring = [&](std::size_t neighbour) {
        const double length = std::hypot(body.radius[neighbour] - r,
                                         body.height[neighbour] - body.height[node]);
        return std::numbers::pi * (3 * r + body.radius[neighbour]) / 4 * length;
    };
    double area = 0;
    if (place > 0) area += half_ring(surface_[place - 1]);
    if (place + 1 < surface_.size()) area += half_ring(surface_[place + 1]);
    return area;
}

void Anvil::accelerate(Body& body, double time_step) {
    for (std::size_t n = 0; n < body.nodes(); ++n) {
        const double mass = body.node_mass[n];
        const double radial_before = body.radial_velocity[n];
        body.radial_velocity[n] += body.radial_impulse[n] / mass;
        if (body.mesh.node_radius[n] == 0) body.radial_velocity[n] = 0;
        const double before = body.axial_velocity[n];
        const double free = before + body.axial_impulse[n] / mass;
        const double face = face_.empty() ? 0 : face_[n];
        const double reach = (face - body.height[n]) / time_step;
        if (free >= reach) {
            body.axial_velocity[n] = free;
            continue;
        }
        // The step ends on the face, which recedes by compliance x impulse / area.
        double after = reach;
        if (const double area = face_.empty() ? 0 : surface_area(body, n); area > 0) {
            const double yielding = compliance_ * mass / (area * time_step);
            after = (reach + yielding * free) / (1 + yielding);
            face_[n] -= yielding * (after - free) * time_step;
        }
        body.axial_velocity[n] = after;
        const double impulse = mass * (after - free);
        body.balance.contact -= impulse * (before + after) / 2;
        const double sliding = body.radial_velocity[n];
        const double slowed = std::min(std::abs(sliding), friction_ * impulse / mass);
        body.radial_velocity[n] -= std::copysign(slowed, sliding);
        body.balance.contact += mass * (sliding - body.radial_velocity[n]) *
                                (radial_before + body.radial_velocity[n]) / 2;
    }
}

}  // namespace taylorcal::axisymmetric
