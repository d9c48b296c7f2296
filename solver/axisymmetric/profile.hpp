#pragma once

#include "solver/axisymmetric/body.hpp"
#include "solver/impact/impact_result.hpp"

namespace taylorcal::axisymmetric {

/// The deformed specimen, standing on its lowest point as on a table. Its outline goes
/// through the centres of the cells' sides, for a cell knows its mean strain alone: where
/// its corners are scatters more, and the foot's rim, the corner of a single cell, is
/// thrown out too far. Edges of the undeformed outline are kept, and its ends have the
/// radius of the sides beside them.
observe::DeformedProfile deformed_profile(const Body& body, const specimen::Shape& shape);

/// One entry a cell.
impact::Fields fields(const Body& body);

}  // namespace taylorcal::axisymmetric
