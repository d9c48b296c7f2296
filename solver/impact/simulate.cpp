#include "solver/impact/simulate.hpp"

namespace taylorcal::impact {

ImpactResult simulate(const ImpactCase& impact_case) {
    if (impact_case.numerics.geometry == Geometry::axisymmetric)
        return axisymmetric::simulate(impact_case);
    return sph::simulate(impact_case);
}

}  // namespace taylorcal::impact
