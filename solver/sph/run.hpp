#pragma once

#include "solver/impact/impact_result.hpp"
#include "solver/sph/body.hpp"

namespace taylorcal::sph {

/// One impact with the strength that `make_strength` makes.
impact::ImpactResult run(const impact::ImpactCase& impact_case,
                         const StrengthFactory& make_strength);

}  // namespace taylorcal::sph
