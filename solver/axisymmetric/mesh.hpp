#pragma once

#include "solver/specimen/shape.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace taylorcal::axisymmetric {

/// The meridian section of a specimen cut into quadrilateral cells; lengths in m. Corners
/// of a cell run counterclockwise in the (r, z) half plane, the first at lower r and z.
struct Mesh {
    std::vector<double> node_radius;
    std::vector<double> node_height;
    std::vector<std::array<std::size_t, 4>> cells;

    std::vector<std::size_t> foot;        ///< nodes of the impact face, from the axis out
    std::vector<std::size_t> rear;        ///< nodes of the rear face, from the axis out
    std::vector<std::size_t> transition;  ///< nodes of the head-rear section, the head's
    std::vector<std::size_t> outline;     ///< free surface, from foot rim to rear rim
};

/// Cuts the profile into `across` columns over the radius of a cylinder's rear and rows
/// to match. A head or a cone has three quarters or five eighths as many columns of its
/// own. Cells of heads and tips start taller than wide, since the impact flattens them.
/// `refined` gives cylinders and the wider head some more columns, cylinders and a cone's
/// tip some more rows, and the cone and the narrower head narrower columns at the rim.
Mesh make_mesh(const specimen::Shape& shape, int across, bool refined);

}  // namespace taylorcal::axisymmetric
