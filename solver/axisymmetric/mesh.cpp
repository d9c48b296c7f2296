#include "solver/axisymmetric/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace taylorcal::axisymmetric {
namespace {

// Height / width of cells at the start. The foot of a cylinder or a head, and far more
// the tip of a cone, is stretched along the frictionless anvil, so that its cells end
// flat.
constexpr double cylinder_aspect = 2;
constexpr double head_aspect = 2;
constexpr double cone_aspect = 6;
// At the middle of the tip the frictionless anvil thins the metal a hundredfold: up to so
// many rows, no taller than so many radii, become one, or thin cells would set the step.
constexpr int cone_tip_rows = 3;
constexpr double cone_tip_radii = 3;
// A cone keeps its columns from tip to rear; fewer than across the rear keep its tip's
// cells, which set the stable step, from becoming needlessly small.
constexpr double cone_column_share = 5.0 / 8;
constexpr std::size_t fewest_columns = 4;

/// One stretch of the profile between two stations, and how it is cut.
struct Section {
    double bottom, top;                ///< heights [m]
    double bottom_radius, top_radius;  ///< [m]
    double aspect;                     ///< cell height / width
};

std::vector<Section> sections_of(const specimen::Shape& shape) {
    std::vector<Section> sections;
    const auto& height = shape.station_height;
    for (std::size_t i = 0; i + 1 < height.size(); ++i) {
        if (height[i + 1] <= height[i]) continue;  // a step
        double aspect = cylinder_aspect;
        if (shape.kind != specimen::ShapeKind::uniform_cylinder &&
            height[i + 1] <= shape.head_length * (1 + 1e-12)) {
            const bool cone = shape.kind == specimen::ShapeKind::truncated_cone;
            aspect = cone ? cone_aspect : head_aspect;
        }
        sections.push_back({height[i], height[i + 1], shape.station_radius[i],
                            shape.station_radius[i + 1], aspect});
    }
    return sections;
}

/// Row boundaries of a section: heights grow with the local radius, so that cells keep
/// their aspect; a boundary falls on `plane` when the section holds it.
std::vector<double> rows_of(const Section& section, std::size_t columns, double plane) {
    std::vector<double> stops = {section.bottom};
    if (plane > section.bottom * (1 + 1e-9) + 1e-12 && plane < section.top * (1 - 1e-9)) {
        stops.push_back(plane);
    }
    stops.push_back(section.top);
    const double slope =
        (section.top_radius - section.bottom_radius) / (section.top - section.bottom);
    std::vector<double> rows = {section.bottom};
    for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
        const double length = stops[s + 1] - stops[s];
        const double low = section.bottom_radius + slope * (stops[s] - section.bottom);
        const double high =
            section.bottom_radius + slope * (stops[s + 1] - section.bottom);
        const bool conical = std::abs(high - low) > 1e-9 * low;
        const double mean_radius = conical ? (high - low) / std::log(high / low) : low;
        const double cell = section.aspect * mean_radius / static_cast<double>(columns);
        const auto count = std::max(1L, std::lround(length / cell));
        for (long j = 1; j <= count; ++j) {
            const double share = static_cast<double>(j) / static_cast<double>(count);
            const double rise = conical ? low * (std::pow(high / low, share) - 1) / slope
                                        : share * length;
            rows.push_back(stops[s] + rise);
        }
        rows.back() = stops[s + 1];
    }
    if (section.top_radius > section.bottom_radius) {
        const double tallest = rows[0] + cone_tip_radii * section.bottom_radius;
        for (int joined = 1; joined < cone_tip_rows; ++joined)
            if (rows.size() > 2 && rows[2] <= tallest) rows.erase(rows.begin() + 1);
    }
    return rows;
}

/// Radii of the column boundaries in units of the section's outer radius, for sections
/// of constant radius: the head's columns are continued by the rear's.
std::vector<double> columns_of(double inner, double outer, int across) {
    const double width = outer / across;
    const auto inside = std::max<std::size_t>(
        fewest_columns, static_cast<std::size_t>(std::lround(inner / width)));
    std::vector<double> radii;
    for (std::size_t i = 0; i <= inside; ++i) {
        radii.push_back(inner * static_cast<double>(i) / static_cast<double>(inside));
    }
    if (outer > inner * (1 + 1e-9)) {
        const auto outside = std::max(1L, std::lround((outer - inner) / width));
        for (long i = 1; i <= outside; ++i) {
            radii.push_back(inner + (outer - inner) * static_cast<double>(i) /
                                        static_cast<double>(outside));
        }
    }
    return radii;
}

}  // namespace

Mesh make_mesh(const specimen::Shape& shape, int across) {
    Mesh mesh;
    const std::vector<Section> sections = sections_of(shape);
    const double rear_radius = shape.rear_radius();
    const bool stepped = sections.size() > 1 &&
                         sections.front().bottom_radius == sections.front().top_radius;
    const double inner = stepped ? sections.front().top_radius : rear_radius;
    const bool cone = shape.kind == specimen::ShapeKind::truncated_cone;
    const auto columns_across =
        cone ? static_cast<int>(std::lround(cone_column_share * across)) : across;
    const std::vector<double> radii = columns_of(inner, rear_radius, columns_across);
    std::size_t inner_columns = 0;
    while (radii[inner_columns] < inner * (1 - 1e-9)) ++inner_columns;

    std::map<std::pair<std::size_t, std::size_t>, std::size_t> index;
    const auto node = [&](std::size_t i, std::size_t j, double scale, double height) {
        const auto [place, made] = index.try_emplace({i, j}, mesh.node_radius.size());
        if (made) {
            mesh.node_radius.push_back(radii[i] * scale);
            mesh.node_height.push_back(height);
        }
        return place->second;
    };

    std::size_t row = 0;
    for (const Section& section : sections) {
        const bool narrow = stepped && section.top <= shape.head_length * (1 + 1e-12);
        const std::size_t columns = narrow ? inner_columns : radii.size() - 1;
        const std::vector<double> rows = rows_of(section, columns, shape.head_length);
        const auto scale_at = [&](double height) {
            const double share =
                (height - section.bottom) / (section.top - section.bottom);
            return std::lerp(section.bottom_radius, section.top_radius, share) /
                   radii[columns];
        };
        for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
            const double low = scale_at(rows[j]);
            const double high = scale_at(rows[j + 1]);
            for (std::size_t i = 0; i < columns; ++i) {
                mesh.cells.push_back({node(i, row + j, low, rows[j]),
                                      node(i + 1, row + j, low, rows[j]),
                                      node(i + 1, row + j + 1, high, rows[j + 1]),
                                      node(i, row + j + 1, high, rows[j + 1])});
            }
        }
        if (row == 0) {
            for (std::size_t i = 0; i <= columns; ++i)
                mesh.foot.push_back(index.at({i, 0}));
        }
        for (std::size_t j = 0; j < rows.size(); ++j) {
            const std::size_t rim = index.at({columns, row + j});
            if (mesh.outline.empty() || mesh.outline.back() != rim) {
                if (j == 0 && row > 0 && stepped) {  // the shoulder, from the head out
                    for (std::size_t i = inner_columns + 1; i < columns; ++i) {
                        mesh.outline.push_back(index.at({i, row}));
                    }
                }
                mesh.outline.push_back(rim);
            }
            if (std::abs(rows[j] - shape.head_length) < 1e-9 * shape.length() &&
                mesh.transition.empty()) {
                for (std::size_t i = 0; i <= (stepped ? inner_columns : columns); ++i) {
                    mesh.transition.push_back(index.at({i, row + j}));
                }
            }
        }
        row += rows.size() - 1;
    }
    for (std::size_t i = 0; i < radii.size(); ++i)
        mesh.rear.push_back(index.at({i, row}));
    return mesh;
}

}  // namespace taylorcal::axisymmetric
