#include "solver/axisymmetric/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace taylorcal::axisymmetric {
namespace {

/// Mean of a node quantity over a section, weighted by area: nodes run from the axis out.
template <class Quantity>
double section_mean(const Body& body, const std::vector<std::size_t>& section,
                    const Quantity& quantity) {
    double sum = 0;
    double area = 0;
    for (std::size_t i = 0; i + 1 < section.size(); ++i) {
        const double inner = body.radius[section[i]];
        const double outer = body.radius[section[i + 1]];
        const double ring = outer * outer - inner * inner;
        sum += ring * (quantity(section[i]) + quantity(section[i + 1])) / 2;
        area += ring;
    }
    return sum / area;
}

/// Whether the undeformed outline turns at its node `i`, as it does at a shoulder and
/// where a cone ends.
bool is_edge(const Mesh& mesh, std::size_t i) {
    constexpr double straight = 1e-6;  // sine of the angle
    if (i == 0 || i + 1 == mesh.outline.size()) return false;
    const auto [last, node, next] =
        std::array{mesh.outline[i - 1], mesh.outline[i], mesh.outline[i + 1]};
    const double r0 = mesh.node_radius[node] - mesh.node_radius[last];
    const double z0 = mesh.node_height[node] - mesh.node_height[last];
    const double r1 = mesh.node_radius[next] - mesh.node_radius[node];
    const double z1 = mesh.node_height[next] - mesh.node_height[node];
    return std::abs(r0 * z1 - z0 * r1) >
           straight * std::hypot(r0, z0) * std::hypot(r1, z1);
}

}  // namespace

observe::DeformedProfile deformed_profile(const Body& body,
                                          const specimen::Shape& shape) {
    observe::DeformedProfile profile;
    const auto height_of = [&](std::size_t n) { return body.height[n]; };
    const double table = *std::min_element(body.height.begin(), body.height.end());
    const auto& outline = body.mesh.outline;
    const auto add = [&](double radius, double height) {
        profile.outline_radius.push_back(radius);
        profile.outline_height.push_back(height - table);
    };
    const auto side_radius = [&](std::size_t i) {
        return std::midpoint(body.radius[outline[i]], body.radius[outline[i + 1]]);
    };
    add(side_radius(0), body.height[outline.front()]);
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const std::size_t n = outline[i];
        if (is_edge(body.mesh, i)) add(body.radius[n], body.height[n]);
        if (n == body.mesh.transition.back())
            profile.head_points = profile.outline_height.size();
        add(side_radius(i), std::midpoint(body.height[n], body.height[outline[i + 1]]));
    }
    add(side_radius(outline.size() - 2), body.height[outline.back()]);
    profile.total_length = section_mean(body, body.mesh.rear, height_of) - table;
    profile.transition_height =
        section_mean(body, body.mesh.transition, height_of) - table;
    profile.transition_radius = body.radius[body.mesh.transition.back()];
    profile.initial_length = shape.length();
    profile.initial_rear_radius = shape.rear_radius();
    return profile;
}

impact::Fields fields(const Body& body) {
    impact::Fields out;
    out.time_us = 1e6 * body.time;
    constexpr double to_mm = 1e3;
    const auto grains = static_cast<std::size_t>(body.numerics.grains_per_point);
    for (std::size_t c = 0; c < body.cells(); ++c) {
        double r = 0, z = 0, r0 = 0, z0 = 0;
        std::array<double, 8> corners{};
        for (std::size_t a = 0; a < 4; ++a) {
            const std::size_t n = body.mesh.cells[c][a];
            corners[2 * a] = body.radius[n] * to_mm;
            corners[2 * a + 1] = body.height[n] * to_mm;
            r += body.radius[n] / 4;
            z += body.height[n] / 4;
            r0 += body.mesh.node_radius[n] / 4;
            z0 += body.mesh.node_height[n] / 4;
        }
        out.corners_mm.push_back(corners);
        out.x_mm.push_back(r * to_mm);
        out.y_mm.push_back(0);
        out.z_mm.push_back(z * to_mm);
        out.initial_x_mm.push_back(r0 * to_mm);
        out.initial_y_mm.push_back(0);
        out.initial_z_mm.push_back(z0 * to_mm);
        out.volume_mm3.push_back(body.ring[c].volume * 1e9);
        double strain = 0, grain = 0, weakened = 0;
        for (std::size_t g = 0; g < grains; ++g) {
            const material::GrainState state = body.strength->state(c * grains + g);
            strain += state.equivalent_plastic_strain / static_cast<double>(grains);
            grain += state.grain_diameter_m / static_cast<double>(grains);
            weakened += state.weakened_fraction / static_cast<double>(grains);
        }
        out.equivalent_plastic_strain.push_back(strain);
        out.grain_diameter_um.push_back(grain * 1e6);
        out.weakened_fraction.push_back(weakened);
        out.temperature_K.push_back(body.thermo[c].temperature);
        out.von_mises_GPa.push_back(von_mises_stress(body.deviator[c]) / 1e9);
        out.pressure_GPa.push_back(body.thermo[c].pressure / 1e9);
    }
    return out;
}

}  // namespace taylorcal::axisymmetric
