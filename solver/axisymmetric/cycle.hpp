#pragma once

#include "solver/axisymmetric/local_steps.hpp"
#include "solver/axisymmetric/self_contact.hpp"

#include <string>

namespace taylorcal::axisymmetric {

/// Advances all cells by a cycle of their own steps, after which they have met; a cycle
/// ends no later than about the time `end` [s]. Returns an empty text, or what went
/// wrong.
std::string take_cycle(Body& body, LocalSteps& steps, SelfContact& self_contact,
                       double end);

}  // namespace taylorcal::axisymmetric
