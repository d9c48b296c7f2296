#pragma once

#include "emulator/inference/model.hpp"

#include <string>

namespace taylorcal::emulator {

/// Gives `wider`, the description of a database with further inputs, the members of `old`
/// with weights of zero for the inputs that `old` did not use, and the old scales of
/// inputs and outputs: it answers as `old` does, bit by bit, whatever the new inputs
/// hold. InputError naming `where` (the old file) unless `wider` has the old inputs,
/// outputs and category.
void widen(Model& wider, const Model& old, const std::string& where);

}  // namespace taylorcal::emulator
