#include "solver/axisymmetric/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace taylorcal::axisymmetric {
namespace {

// Height / width of cells at the start. Long waves run up the rear with their plastic
// front, and rows taller than its columns are wide smear it: lengths come out too short
// by half a per cent. Heads are flattened by the impact, the more the nearer to a cone's
// tip.
constexpr double square_aspect = 1;
constexpr double head_aspect = 2;
constexpr double tip_aspect = 6, refined_tip_aspect = 3;
constexpr double cone_tip_radii = 4;  // of the tip: above, a cone's cells are square
// Where a cylinder ceases to be undeformed is decided by the elastic waves that run to
// and fro before the plastic front, and thus by all rows: tall ones in the rear smear
// them.
constexpr double cylinder_aspect = 0.8;  // at the foot, above its lowest rows
constexpr double cylinder_growth = 0.05, refined_cylinder_growth = 0.02;  // a radius
constexpr double cylinder_square_radii = 0.2;  // flat cells let the foot's rim run ahead
// Columns of a narrow section, of those across the rear: it decides the sizes.
constexpr double head_column_share = 3.0 / 4;
constexpr double cone_column_share = 5.0 / 8;
constexpr std::size_t fewest_columns = 4;
constexpr int row_samples = 2000;

/// How a shape is cut.
struct Division {
    double columns;  ///< across the rear, of those asked for
    double rim;  ///< width at a head's or cone's rim, over the mean: falls evenly to it
};

/// Refined divisions are what brings sizes to their limits within 1 % or so
/// (tests/verification, convergence); the others are cheaper. Narrow columns
/// at the rim follow the foot as it spreads and cost nothing, for it is the flattened
/// cells' height that sets their steps; narrower ones than a cone's gain energy in hard
/// metal that rings. Heads of other widths are cut as the nearer of the paper's two.
Division division_of(const specimen::Profile& profile, bool refined) {
    constexpr double between_heads =
        (specimen::reduced_head_3mm.end_radius + specimen::reduced_head_4mm.end_radius) /
        2;
    switch (profile.kind) {
        case specimen::ProfileKind::stepped:
            if (profile.end_radius > between_heads) return {refined ? 11.0 / 8 : 1, 1};
            return {9.0 / 8, refined ? 0.8 : 1};
        case specimen::ProfileKind::tapered:
            return {1, refined ? 0.25 : 1};
        case specimen::ProfileKind::cylinder:
            break;
    }
    return {refined ? 10.0 / 8 : 1, 1};
}

/// One stretch of the profile between two stations.
struct Section {
    double bottom, top;                ///< heights [m]
    double bottom_radius, top_radius;  ///< [m]
    specimen::ProfileKind kind;        ///< of the specimen
    bool head;                         ///< below the head-rear section
    bool refined;                      ///< cut into more rows

    double radius_at(double height) const {
        return std::lerp(bottom_radius, top_radius, (height - bottom) / (top - bottom));
    }
    double aspect_at(double height) const {
        const double radii = (height - bottom) / bottom_radius;
        if (kind == specimen::ProfileKind::cylinder)
            return radii < cylinder_square_radii
                       ? square_aspect
                       : cylinder_aspect +
                             (refined ? refined_cylinder_growth : cylinder_growth) *
                                 radii;
        if (!head) return square_aspect;
        if (kind != specimen::ProfileKind::tapered) return head_aspect;
        const double share = std::min(1.0, radii / cone_tip_radii);
        return std::lerp(refined ? refined_tip_aspect : tip_aspect, square_aspect, share);
    }
};

std::vector<Section> sections_of(const specimen::Shape& shape, bool refined) {
    std::vector<Section> sections;
    const auto& height = shape.station_height;
    for (std::size_t i = 0; i + 1 < height.size(); ++i) {
        if (height[i + 1] <= height[i]) continue;  // a step
        const bool head = height[i + 1] <= shape.head_length * (1 + 1e-12);
        sections.push_back({height[i], height[i + 1], shape.station_radius[i],
                            shape.station_radius[i + 1], shape.profile.kind, head,
                            refined});
    }
    return sections;
}

/// Appends the row boundaries above `bottom` up to `top`: as many rows as the cells'
/// height asks for, each with the same share of int dz/height.
void append_rows(const Section& section, double columns, double bottom, double top,
                 std::vector<double>& rows) {
    const double sample = (top - bottom) / row_samples;
    std::vector<double> sum = {0};  // rows below the end of each sample
    for (int i = 0; i < row_samples; ++i) {
        const double z = bottom + sample * (i + 0.5);
        const double height = section.aspect_at(z) * section.radius_at(z) / columns;
        sum.push_back(sum.back() + sample / height);
    }
    const long count = std::max(1L, std::lround(sum.back()));
    for (long j = 1; j < count; ++j) {
        const double wanted =
            sum.back() * static_cast<double>(j) / static_cast<double>(count);
        const auto above = std::upper_bound(sum.begin(), sum.end(), wanted);
        const double share = (wanted - *(above - 1)) / (*above - *(above - 1));
        rows.push_back(bottom +
                       sample * (static_cast<double>(above - 1 - sum.begin()) + share));
    }
    rows.push_back(top);
}

/// Row boundaries of a section; one falls on `plane` when the section holds it.
std::vector<double> rows_of(const Section& section, std::size_t columns, double plane) {
    const auto across = static_cast<double>(columns);
    std::vector<double> rows = {section.bottom};
    if (plane > section.bottom * (1 + 1e-9) + 1e-12 && plane < section.top * (1 - 1e-9))
        append_rows(section, across, section.bottom, plane, rows);
    append_rows(section, across, rows.back(), section.top, rows);
    return rows;
}

/// Radii of the column boundaries in units of the section's outer radius, for sections
/// of constant radius: the head's columns are continued by the rear's. `rim`: see
/// Division.
std::vector<double> columns_of(double inner, double outer, double share, long across,
                               double rim) {
    const double width = outer / static_cast<double>(across);
    const auto inside = std::max(
        fewest_columns,
        static_cast<std::size_t>(std::lround(share * static_cast<double>(across))));
    std::vector<double> radii;
    for (std::size_t i = 0; i <= inside; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(inside);
        radii.push_back(inner * x * (1 + (1 - rim) * (1 - x)));
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

Mesh make_mesh(const specimen::Shape& shape, int wanted_across, bool refined) {
    Mesh mesh;
    const Division division = division_of(shape.profile, refined);
    const long across = std::lround(division.columns * wanted_across);
    const std::vector<Section> sections = sections_of(shape, refined);
    const double rear_radius = shape.rear_radius();
    const bool stepped = sections.size() > 1 &&
                         sections.front().bottom_radius == sections.front().top_radius;
    const double inner = stepped ? sections.front().top_radius : rear_radius;
    double share = stepped ? head_column_share : 1;
    if (shape.profile.kind == specimen::ProfileKind::tapered) share = cone_column_share;
    const std::vector<double> radii =
        columns_of(inner, rear_radius, share, across, division.rim);
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
            return section.radius_at(height) / radii[columns];
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
