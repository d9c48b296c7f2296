#pragma once

#include "emulator/inference/model.hpp"
#include "emulator/training/dataset.hpp"
#include "emulator/training/train_config.hpp"

namespace taylorcal::emulator {

/// Trains all members, one a thread, picks the best on held-out rows and measures it. The
/// result is the same for any number of threads. NumericalError if all members diverge.
Model train_emulator(const TrainConfig& config, const Dataset& data, int threads);

}  // namespace taylorcal::emulator
