#include "emulator/training/train_member.hpp"

#include "emulator/training/adam.hpp"
#include "emulator/training/streams.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace taylorcal::emulator {

namespace {

using FloatNetwork = Network<float>;
using FloatBlock = FloatNetwork::Block;

/// Rises first, for Adam's first steps go by the signs of a few gradients only, then
/// falls to zero along a cosine.
double learning_rate_at(double progress, double largest) {
    constexpr double warm_up = 0.02;
    const double rising = std::min(progress / warm_up, 1.0);
    return largest * rising * 0.5 * (1 + std::cos(std::numbers::pi * progress));
}

/// Shrinking the weights smooths a network that has more parameters than rows to learn
/// from; letting go towards the end removes the bias that this leaves. (Of the decays and
/// schedules tried on smooth functions of 7 inputs with 500 and 2000 noisy rows, a start
/// at 0.1 is the best for both; rows without noise are learnt better without any.)
double weight_decay_at(double progress, double at_start) {
    return at_start * (1 - progress) * (1 - progress);
}

/// Fisher-Yates with counters that no other epoch uses.
void shuffle(std::vector<Eigen::Index>& order, const RandomStream& random, int epoch) {
    const std::uint64_t first = static_cast<std::uint64_t>(epoch) * order.size();
    for (std::size_t i = order.size() - 1; i > 0; --i) {
        const double pick = random.uniform(first + i) * static_cast<double>(i + 1);
        std::swap(order[i], order[static_cast<std::size_t>(pick)]);
    }
}

struct Batch {
    FloatBlock inputs;
    FloatBlock targets;
    FloatBlock mask;

    void gather(const Samples& from, const std::vector<Eigen::Index>& order,
                std::size_t begin, std::size_t end) {
        const auto n = static_cast<Eigen::Index>(end - begin);
        inputs.resize(from.inputs.rows(), n);
        targets.resize(from.targets.rows(), n);
        mask.resize(from.mask.rows(), n);
        for (Eigen::Index j = 0; j < n; ++j) {
            const Eigen::Index row = order[begin + static_cast<std::size_t>(j)];
            inputs.col(j) = from.inputs.col(row);
            targets.col(j) = from.targets.col(row);
            mask.col(j) = from.mask.col(row);
        }
    }
};

double validation_rms(FloatNetwork& network, const Batch& held_out) {
    const FloatBlock error =
        held_out.mask * (network.forward(held_out.inputs) - held_out.targets);
    return std::sqrt(static_cast<double>(error.square().sum() / held_out.mask.sum()));
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Member train_member(const MemberSettings& settings, const Samples& training,
                    const Samples& validation, const MemberWatch& watch) {
    const bool goes_on = !settings.start.empty();
    FloatNetwork network = goes_on ? FloatNetwork(settings.start)
                                   : FloatNetwork(settings.widths, settings.seed);
    if (watch.found) network.parameters() = watch.found->parameters;
    Adam<float> adam = watch.found ? Adam<float>(watch.found->adam)
                                   : Adam<float>(network.parameters().size());
    const RandomStream random(settings.seed, streams::shuffle);

    std::vector<Eigen::Index> order(static_cast<std::size_t>(training.rows()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::vector<Eigen::Index> all(static_cast<std::size_t>(validation.rows()));
    std::iota(all.begin(), all.end(), Eigen::Index{0});
    Batch held_out;
    held_out.gather(validation, all, 0, all.size());

    // Batches of nearly equal size: a small rest would weigh as much as a full one.
    const auto batch_size = static_cast<std::size_t>(settings.batch_size);
    const std::size_t batches = (order.size() + batch_size - 1) / batch_size;
    const int epochs_between_looks = std::max(1, settings.epochs / 500);
    Batch batch;
    FloatNetwork::Vector best = watch.found ? watch.found->best : network.parameters();
    double lowest = watch.found ? watch.found->lowest
                    : goes_on   ? validation_rms(network, held_out)
                                : std::numeric_limits<double>::infinity();
    const int first = watch.found ? watch.found->epochs : 0;
    // Each shuffle starts from the order that the one before left.
    for (int epoch = 0; epoch < first; ++epoch) shuffle(order, random, epoch);
    Clock::time_point kept = Clock::now();
    for (int epoch = first; epoch < settings.epochs; ++epoch) {
        shuffle(order, random, epoch);
        for (std::size_t b = 0; b < batches; ++b) {
            batch.gather(training, order, b * order.size() / batches,
                         (b + 1) * order.size() / batches);
            network.backward(batch.inputs, batch.targets, batch.mask);
            const double share =
                static_cast<double>(b + 1) / static_cast<double>(batches);
            const double progress = (epoch + share) / settings.epochs;
            adam.step(
                network.parameters(), network.gradient(),
                static_cast<float>(learning_rate_at(progress, settings.learning_rate)),
                static_cast<float>(weight_decay_at(progress, settings.weight_decay)) *
                    network.is_weight());
        }
        if ((epoch + 1) % epochs_between_looks == 0 || epoch + 1 == settings.epochs) {
            const double rms = validation_rms(network, held_out);
            if (rms < lowest) {
                lowest = rms;
                best = network.parameters();
            }
        }
        watch.after_epoch(lowest);
        if (seconds_since(kept) >= watch.interval_s || epoch + 1 == settings.epochs) {
            watch.keep({epoch + 1, network.parameters(), adam.state(), best, lowest});
            kept = Clock::now();
        }
    }
    network.parameters() = best;
    return {network.layers(), settings.seed, settings.batch_size, settings.learning_rate,
            lowest};
}

}  // namespace taylorcal::emulator
