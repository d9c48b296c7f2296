#pragma once

#include "calibrate/prior_pass/pruning.hpp"
#include "calibrate/prior_pass/row_network.hpp"
#include "calibrate/prior_pass/unit_sequence.hpp"

#include <cstdint>
#include <vector>

namespace taylorcal::calibrate {

/// Everything that the draws of one pass have in common.
struct PlainPass {
    const RowNetwork& network;
    const Pruning& pruning;
    const UnitSequence& sequence;
    std::vector<std::size_t> row_order;
    std::uint64_t draws = 0;
};

/// What became of the draws of one block.
struct DrawBlock {
    std::uint64_t number = 0;
    std::uint64_t draws = 0;
    std::uint64_t rows_seen = 0;  ///< of all draws together
    /// Sum over the dropped draws of exp(bound of ln L - ln threshold).
    double dropped = 0;
    /// Those that saw all rows.
    std::vector<UnitSequence::Words> words;
    std::vector<std::uint32_t> place;         ///< in the block
    std::vector<std::vector<float>> misfits;  ///< [misfit][draw]
};

/// Takes the draws of a block through the rows in the pass's order. Those that have
/// dropped out make room: after each row the others move together.
DrawBlock evaluate_block(const PlainPass& pass, std::uint64_t number);

/// The order of rows that drops draws soonest: each next row is the one that leaves
/// fewest of a few thousand prior draws that have got so far.
std::vector<std::size_t> discriminating_order(const RowNetwork& network,
                                              const Pruning& pruning,
                                              const UnitSequence& sequence);

}  // namespace taylorcal::calibrate
