#include "solver/impact/simulate.hpp"

#include <fmt/core.h>

namespace taylorcal::impact {
namespace {

// A run that creates or loses more of its energy is wrong however good it looks: metal so
// strong that it bounces elastically, with too long a step.
constexpr double largest_energy_error = 0.02;

void check_energy(ImpactResult& result) {
    const double error = result.descriptors.energy_error;
    if (result.status == Status::failed || error <= largest_energy_error) return;
    result.status = Status::failed;
    result.reason = fmt::format("the energy balance is off by {:.2g} % (at most {:g} %)",
                                100 * error, 100 * largest_energy_error);
}

}  // namespace

ImpactResult simulate(const ImpactCase& impact_case) {
    ImpactResult result = impact_case.numerics.geometry == Geometry::axisymmetric
                              ? axisymmetric::simulate(impact_case)
                              : sph::simulate(impact_case);
    check_energy(result);
    return result;
}

}  // namespace taylorcal::impact
