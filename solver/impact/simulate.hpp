#pragma once

#include "solver/impact/impact_case.hpp"
#include "solver/impact/impact_result.hpp"

namespace taylorcal::axisymmetric {
/// Computes one impact in (r, z). Never throws for what happens to the specimen: a run
/// that goes wrong has status `failed` and a reason.
impact::ImpactResult simulate(const impact::ImpactCase& impact_case);
}  // namespace taylorcal::axisymmetric

namespace taylorcal::sph {
/// The same in three dimensions with particles.
impact::ImpactResult simulate(const impact::ImpactCase& impact_case);
}  // namespace taylorcal::sph

namespace taylorcal::impact {
/// Dispatches to the case's geometry; a run whose energy is not balanced within 2 % has
/// failed.
ImpactResult simulate(const ImpactCase& impact_case);
}  // namespace taylorcal::impact
