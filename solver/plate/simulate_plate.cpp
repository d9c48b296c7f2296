#include "solver/plate/simulate_plate.hpp"

#include "common/errors.hpp"
#include "solver/plate/column.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace taylorcal::plate {
namespace {

constexpr double step_growth = 1.05;

void observe(const Column& column, double time, PlateResult& result) {
    const std::vector<double>& velocity = column.velocity();
    result.history.push_back({time, velocity.back(), velocity[column.flyer_nodes()]});
    const std::size_t middle = (column.flyer_cells() + column.cells()) / 2;
    result.largest_stress = std::max(result.largest_stress, -column.stress(middle));
    for (std::size_t c = 0; c < column.cells(); ++c) {
        result.largest_tension = std::max(result.largest_tension, column.stress(c));
        result.largest_temperature_K =
            std::max(result.largest_temperature_K, column.temperature(c));
    }
}

}  // namespace

PlateResult simulate_plate(const PlateCase& plate_case) {
    Column column(plate_case);
    PlateResult result;
    const double initial = column.kinetic_energy();
    double time = 0;
    double step = column.stable_step() / 100;  // the first touch is the steepest
    double last = 0;
    while (time < plate_case.duration) {
        column.accelerate((last + step) / 2);
        const std::string trouble = column.advance(step);
        if (!trouble.empty())
            throw NumericalError(fmt::format("{} after {:.4g} us", trouble, 1e6 * time));
        time += step;
        last = step;
        ++result.steps;
        observe(column, time - step / 2, result);
        step = std::min(step_growth * step, column.stable_step());
    }
    result.energy_error =
        std::abs(column.kinetic_energy() + column.internal_energy() - initial) / initial;
    return result;
}

}  // namespace taylorcal::plate
