#pragma once

#include "solver/axisymmetric/body.hpp"
#include "solver/impact/impact_result.hpp"

namespace taylorcal::axisymmetric {

/// The deformed outline, standing on its lowest point as on a table.
observe::DeformedProfile deformed_profile(const Body& body, const specimen::Shape& shape);

/// One entry a cell.
impact::Fields fields(const Body& body);

}  // namespace taylorcal::axisymmetric
