#pragma once

#include "common/json_reader.hpp"
#include "solver/commands/cli_app.hpp"
#include "solver/plate/plate_case.hpp"
#include "solver/plate/simulate_plate.hpp"

#include <string>

namespace taylorcal::commands {

/// Reads plate.json strictly. InputError names file, key, value and remedy.
plate::PlateCase read_plate_case(const JsonReader& reader);

/// time_us, free_surface_velocity_m_s, interface_velocity_m_s.
std::string to_csv(const plate::PlateResult& result);

/// Adds `solver plate plate.json --out velocity.csv`: a flyer plate experiment.
void add_plate(CLI::App& app);

}  // namespace taylorcal::commands
