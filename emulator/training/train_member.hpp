#pragma once

#include "emulator/training/network.hpp"
#include "emulator/training/samples.hpp"

#include <functional>

namespace taylorcal::emulator {

/// How one member learns.
struct MemberSettings {
    std::vector<Eigen::Index> widths;  ///< Inputs, hidden layers, outputs.
    std::uint64_t seed = 1;  ///< Of the first weights and the order of the rows.
    int batch_size = 32;
    double learning_rate = 1e-2;  ///< The largest.
    double weight_decay = 0.1;    ///< At the start.
    int epochs = 1000;
    std::vector<Layer> start;  ///< Layers to go on from; empty: random ones of `widths`.
};

/// Trains one member by Adam on mini-batches and keeps the state that was best on the
/// held-out rows, the first one too if it was trained before. `after_epoch` is told the
/// lowest validation RMS so far.
Member train_member(const MemberSettings& settings, const Samples& training,
                    const Samples& validation,
                    const std::function<void(double)>& after_epoch);

}  // namespace taylorcal::emulator
