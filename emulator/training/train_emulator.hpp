#pragma once

#include "emulator/inference/model.hpp"
#include "emulator/training/checkpoints.hpp"
#include "emulator/training/dataset.hpp"
#include "emulator/training/train_config.hpp"

#include <string>

namespace taylorcal::emulator {

/// Trains all members, one a thread, picks the best on held-out rows and measures it. The
/// result is the same for any number of threads, and whether or not the training was
/// killed and goes on from `checkpoints`. NumericalError if all members diverge.
Model train_emulator(const TrainConfig& config, const Dataset& data, int threads,
                     const Checkpoints& checkpoints = {});

/// Trains the networks of `old`, read from `where`, on a database with further inputs:
/// each member starts from an old one, which it equals until the first step (see
/// widen.hpp). Layers and neurons are the old ones, whatever the configuration says.
Model train_further(const Model& old, const std::string& where, const TrainConfig& config,
                    const Dataset& data, int threads,
                    const Checkpoints& checkpoints = {});

}  // namespace taylorcal::emulator
