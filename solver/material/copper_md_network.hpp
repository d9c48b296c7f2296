#pragma once

#include <string>

namespace taylorcal::material {

/// The text of experiments/equation_of_state/network.json, built into the program so that
/// it computes the same wherever it runs.
std::string copper_md_network();

}  // namespace taylorcal::material
