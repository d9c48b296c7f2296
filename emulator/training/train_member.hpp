#pragma once

#include "emulator/training/adam.hpp"
#include "emulator/training/network.hpp"
#include "emulator/training/samples.hpp"

#include <functional>
#include <optional>

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

/// A member between two epochs: with it the training goes on bit by bit as if it had
/// never stopped.
struct MemberState {
    int epochs = 0;  ///< done so far
    Network<float>::Vector parameters;
    AdamState<float> adam;
    Network<float>::Vector best;  ///< parameters that were best on the held-out rows
    double lowest = 0;            ///< validation RMS of those
};

/// How a member's training is watched and survives a kill.
struct MemberWatch {
    /// Told the lowest validation RMS so far, after each epoch.
    std::function<void(double)> after_epoch = [](double) {};
    std::optional<MemberState> found = {};  ///< to go on from
    /// Given the state every `interval_s` seconds and at the end.
    std::function<void(const MemberState&)> keep = [](const MemberState&) {};
    double interval_s = 1;
};

/// Trains one member by Adam on mini-batches and keeps the state that was best on the
/// held-out rows, the first one too if it was trained before.
Member train_member(const MemberSettings& settings, const Samples& training,
                    const Samples& validation, const MemberWatch& watch = {});

}  // namespace taylorcal::emulator
