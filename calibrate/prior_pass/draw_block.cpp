#include "calibrate/prior_pass/draw_block.hpp"

#include "calibrate/prior_pass/layer_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taylorcal::calibrate {
namespace {

/// The draws that are left, in a structure of arrays.
struct Survivors {
    std::array<std::vector<std::uint32_t>, UnitSequence::most_dimensions> words;
    RowNetwork::Inputs inputs;
    std::vector<std::vector<float>> misfits;
    std::vector<std::uint32_t> place;
    std::vector<float> depth;
    std::size_t count = 0;
};

/// exp(-depth), which falls to nothing: counted as exp(-30) beyond 30.
double bound_of(float depth) {
    constexpr float far = 30;
    constexpr double least = 9.4e-14;
    return depth > far ? least : std::exp(-static_cast<double>(depth));
}

/// Moves the draws that stay together and returns the dropped ones' share of the bound.
double compact(Survivors& draws, const Pruning& pruning, std::size_t parameters) {
    for (std::size_t i = 0; i < draws.count; ++i)
        draws.depth[i] =
            pruning.depth([&](std::size_t m) { return draws.misfits[m][i]; });
    double dropped = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < draws.count; ++i) {
        // Not: depth > 0. A misfit that is not finite is worth nothing either.
        const bool stays = draws.depth[i] <= 0;
        draws.place[kept] = draws.place[i];
        for (std::size_t d = 0; d < parameters; ++d)
            draws.inputs[d][kept] = draws.inputs[d][i];
        for (std::vector<float>& misfit : draws.misfits) misfit[kept] = misfit[i];
        kept += stays ? 1 : 0;
        if (!stays) dropped += bound_of(draws.depth[i]);
    }
    draws.count = kept;
    return dropped;
}

}  // namespace

DrawBlock evaluate_block(const PlainPass& pass, std::uint64_t number) {
    thread_local Survivors draws;
    thread_local RowNetwork::Workspace workspace;
    DrawBlock block;
    block.number = number;
    block.draws =
        std::min(UnitSequence::block, pass.draws - number * UnitSequence::block);
    draws.count = block.draws;
    const std::size_t room = draws.count + chunk_width;
    pass.sequence.fill(number, draws.count, draws.words);
    pass.network.standardise(draws.words, draws.inputs);
    draws.misfits.assign(pass.network.misfits(), std::vector<float>(room, 0));
    draws.depth.assign(room, 0);
    draws.place.resize(room);
    std::iota(draws.place.begin(), draws.place.end(), 0U);
    for (const std::size_t row : pass.row_order) {
        for (std::size_t first = 0; first < draws.count; first += chunk_width)
            pass.network.add_misfits(row, draws.inputs, first,
                                     std::min(chunk_width, draws.count - first),
                                     draws.misfits, workspace);
        block.rows_seen += draws.count;
        block.dropped += compact(draws, pass.pruning, pass.network.parameters());
        if (draws.count == 0) break;
    }
    block.place.assign(draws.place.begin(),
                       draws.place.begin() + static_cast<std::ptrdiff_t>(draws.count));
    for (const std::uint32_t place : block.place) {
        UnitSequence::Words words{};
        for (std::size_t d = 0; d < pass.sequence.dimensions(); ++d)
            words[d] = draws.words[d][place];
        block.words.push_back(words);
    }
    for (const std::vector<float>& misfit : draws.misfits)
        block.misfits.emplace_back(
            misfit.begin(), misfit.begin() + static_cast<std::ptrdiff_t>(draws.count));
    return block;
}

std::vector<std::size_t> discriminating_order(const RowNetwork& network,
                                              const Pruning& pruning,
                                              const UnitSequence& sequence) {
    constexpr std::size_t count = UnitSequence::block;
    Survivors draws;
    RowNetwork::Workspace workspace;
    sequence.fill(0, count, draws.words);
    network.standardise(draws.words, draws.inputs);
    const std::vector<std::vector<float>> none(
        network.misfits(), std::vector<float>(count + chunk_width, 0));
    std::vector<std::vector<std::vector<float>>> of_row(network.rows(), none);
    for (std::size_t row = 0; row < network.rows(); ++row)
        for (std::size_t first = 0; first < count; first += chunk_width)
            network.add_misfits(row, draws.inputs, first, chunk_width, of_row[row],
                                workspace);

    std::vector<std::vector<float>> total = none;
    std::vector<std::size_t> alive(count), left(network.rows()), order;
    std::iota(alive.begin(), alive.end(), std::size_t{0});
    std::iota(left.begin(), left.end(), std::size_t{0});
    const auto depth_after = [&](std::size_t row, std::size_t i) {
        return pruning.depth(
            [&](std::size_t m) { return total[m][i] + of_row[row][m][i]; });
    };
    while (!left.empty()) {
        // Ties, as when all are left or none, go to the row that comes nearest to it.
        const auto worth = [&](std::size_t row) {
            std::size_t dropped = 0;
            double depth = 0;
            for (const std::size_t i : alive) {
                const float after = depth_after(row, i);
                dropped += after > 0 ? 1 : 0;
                depth += std::min(after, 0.0f);
            }
            return std::pair(dropped, depth);
        };
        std::size_t best = 0;
        auto most = worth(left[0]);
        for (std::size_t k = 1; k < left.size(); ++k) {
            const auto found = worth(left[k]);
            if (found > most) {
                most = found;
                best = k;
            }
        }
        const std::size_t row = left[best];
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
        order.push_back(row);
        std::vector<std::size_t> next;
        for (const std::size_t i : alive)
            if (depth_after(row, i) <= 0) next.push_back(i);
        for (std::size_t m = 0; m < total.size(); ++m)
            for (std::size_t i = 0; i < count; ++i) total[m][i] += of_row[row][m][i];
        if (!next.empty()) alive = next;
    }
    return order;
}

}  // namespace taylorcal::calibrate
