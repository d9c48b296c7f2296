#include "solver/plate/column.hpp"

#include "solver/material/grain_orientations.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace taylorcal::plate {
namespace {

constexpr std::size_t grains = material::lane_count<float>;  // one block a cell
constexpr double linear_viscosity = 0.1;
constexpr double quadratic_viscosity = 1.5;
constexpr double courant_number = 0.5;

std::size_t cells_in(double thickness, double cell) {
    return static_cast<std::size_t>(std::max(2.0, std::ceil(thickness / cell - 1e-9)));
}

}  // namespace

Column::Column(const PlateCase& plate_case)
    : flyer_cells_(cells_in(plate_case.flyer_thickness, plate_case.cell)),
      parameters_(plate_case.material),
      equation_of_state_(material::make_equation_of_state(plate_case.material)) {
    const std::size_t target_cells =
        cells_in(plate_case.target_thickness, plate_case.cell);
    const std::size_t count = flyer_cells_ + target_cells;
    strength_ = material::make_strength<float>(
        parameters_, material::grain_orientations(count, grains, plate_case.seed));
    const double density =
        equation_of_state_->density_at_temperature(plate_case.initial_temperature_K);
    const double energy =
        equation_of_state_->energy_at_temperature(plate_case.initial_temperature_K);
    density_.assign(count, density);
    energy_.assign(count, energy);
    thermo_.assign(count, equation_of_state_->at(density, energy));
    deviator_.assign(count, 0.0);
    viscous_pressure_.assign(count, 0.0);
    node_mass_.assign(count + 2, 0.0);
    const auto add_plate = [&](std::size_t cells, double thickness, double velocity,
                               double first) {
        const double height = thickness / static_cast<double>(cells);
        for (std::size_t n = 0; n <= cells; ++n) {
            position_.push_back(first + height * static_cast<double>(n));
            velocity_.push_back(velocity);
        }
        cell_mass_.insert(cell_mass_.end(), cells, density * height);
    };
    add_plate(flyer_cells_, plate_case.flyer_thickness, plate_case.velocity,
              -plate_case.flyer_thickness);
    add_plate(target_cells, plate_case.target_thickness, 0, 0);
    for (std::size_t c = 0; c < count; ++c) {
        node_mass_[left_node(c)] += cell_mass_[c] / 2;
        node_mass_[left_node(c) + 1] += cell_mass_[c] / 2;
    }
}

double Column::stable_step() const {
    double shortest = INFINITY;
    for (std::size_t c = 0; c < cells(); ++c) {
        const double bulk = thermo_[c].bulk_modulus;
        const double shear = material::shear_modulus(bulk, parameters_.poisson_ratio);
        // A viscous front is faster than sound: q adds to the stiffness it resists with.
        const double stiffness = bulk + 4 * shear / 3 + 4 * viscous_pressure_[c];
        const double height = cell_mass_[c] / density_[c];
        shortest = std::min(shortest, height / std::sqrt(stiffness / density_[c]));
    }
    return courant_number * shortest;
}

void Column::accelerate(double interval) {
    gained_ += join_plates();  // what the first touch takes from the motion
    std::vector<double> force(velocity_.size(), 0.0);
    for (std::size_t c = 0; c < cells(); ++c) {
        const double pull = stress(c) - viscous_pressure_[c];
        force[left_node(c)] += pull;
        force[left_node(c) + 1] -= pull;
    }
    for (std::size_t n = 0; n < velocity_.size(); ++n)
        velocity_[n] += force[n] / node_mass_[n] * interval;
    join_plates();  // the push that the plates give each other
}

/// Faces that touch and approach share their momentum; nothing holds them together.
/// Returns the kinetic energy lost [J/m2].
double Column::join_plates() {
    const std::size_t a = flyer_cells_, b = flyer_cells_ + 1;
    if (position_[a] < position_[b] || velocity_[a] <= velocity_[b]) return 0;
    const double mass = node_mass_[a] + node_mass_[b];
    const double shared =
        (node_mass_[a] * velocity_[a] + node_mass_[b] * velocity_[b]) / mass;
    const double closing = velocity_[a] - velocity_[b];
    velocity_[a] = velocity_[b] = shared;
    return node_mass_[a] * node_mass_[b] / mass * closing * closing / 2;
}

std::string Column::advance(double step) {
    for (std::size_t n = 0; n < position_.size(); ++n)
        position_[n] += velocity_[n] * step;
    position_[flyer_cells_] =
        std::min(position_[flyer_cells_], position_[flyer_cells_ + 1]);
    material::BlockInput<float> input{};
    input.time_step = static_cast<float>(step);
    material::BlockOutput<float> output;
    for (std::size_t c = 0; c < cells(); ++c) {
        const std::size_t left = left_node(c);
        const double height = position_[left + 1] - position_[left];
        if (!(height > 0)) return fmt::format("cell {} folded over", c);
        const double closing = velocity_[left + 1] - velocity_[left];
        const double strain_rate = closing / (height - closing * step / 2);
        const double old_density = density_[c];
        density_[c] = cell_mass_[c] / height;
        input.velocity_gradient[0] = static_cast<float>(strain_rate);
        input.density = static_cast<float>(density_[c]);
        input.temperature = static_cast<float>(thermo_[c].temperature);
        input.shear_modulus = material::broadcast(static_cast<float>(
            material::shear_modulus(thermo_[c].bulk_modulus, parameters_.poisson_ratio)));
        strength_->update(c, input, output);
        double deviator = 0, plastic_power = 0;
        for (std::size_t lane = 0; lane < grains; ++lane) {
            deviator += static_cast<double>(output.stress_deviator[0][lane]) / grains;
            plastic_power += static_cast<double>(output.plastic_power[lane]) / grains;
        }
        double viscous = 0;
        if (closing < 0) {
            const double sound = std::sqrt(thermo_[c].bulk_modulus / density_[c]);
            viscous = density_[c] * -closing *
                      (linear_viscosity * sound + quadratic_viscosity * -closing);
        }
        // rho dE/dt = -(P + q) div v + beta S : wdot, Eq. 3, the pressure by one
        // correction.
        const double expansion = 1 / density_[c] - 1 / old_density;
        const double mean_viscous = (viscous_pressure_[c] + viscous) / 2;
        const double mean_density = (old_density + density_[c]) / 2;
        const double heat =
            parameters_.taylor_quinney * plastic_power * step / mean_density -
            mean_viscous * expansion;
        const double old_pressure = thermo_[c].pressure;
        const double guess =
            equation_of_state_
                ->at(density_[c], energy_[c] + heat - old_pressure * expansion)
                .pressure;
        energy_[c] += heat - (old_pressure + guess) / 2 * expansion;
        thermo_[c] = equation_of_state_->at(density_[c], energy_[c]);
        gained_ +=
            closing * step *
            ((deviator_[c] + deviator) / 2 - (old_pressure + guess) / 2 - mean_viscous);
        deviator_[c] = deviator;
        viscous_pressure_[c] = viscous;
        if (!std::isfinite(stress(c)))
            return fmt::format("the stress of cell {} is not finite", c);
    }
    return {};
}

double Column::kinetic_energy() const {
    double sum = 0;
    for (std::size_t n = 0; n < velocity_.size(); ++n)
        sum += node_mass_[n] * velocity_[n] * velocity_[n] / 2;
    return sum;
}

double Column::internal_energy() const { return gained_; }

}  // namespace taylorcal::plate
