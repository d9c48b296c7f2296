#pragma once

#include "calibrate/sampling/draw_table.hpp"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <vector>

namespace taylorcal::calibrate {

/// Draws to be evaluated with one proposal.
struct Pass {
    const LotLikelihood& likelihood;
    const Proposal& proposal;
    DrawNumbers numbers;
    std::uint64_t draws = 0;
    std::uint64_t draws_per_lot = 1;
    int threads = 1;
    std::uint64_t done = 0;  ///< draws before, of whole blocks
};

/// Evaluates a pass block by block: `work(table)` runs on several threads,
/// `consume(result)` on one, in the order of the blocks. Memory holds a few blocks only,
/// and the size of a block does not depend on the number of threads: hence the same bytes
/// for any number. `after_batch()` is called whenever nothing waits to be consumed.
template <class Work, class Consume, class AfterBatch>
void run_pass(const Pass& pass, const Work& work, const Consume& consume,
              const AfterBatch& after_batch) {
    using Result = decltype(work(std::declval<DrawTable>()));
    constexpr std::uint64_t points_per_block = 1024;
    constexpr std::uint64_t blocks_per_batch = 32;
    const bool nested = pass.likelihood.space().per_lot_count() > 0;
    const std::uint64_t inner = nested ? pass.draws_per_lot : 1;
    const std::uint64_t size = std::max<std::uint64_t>(points_per_block / inner, 1);
    const std::uint64_t blocks = (pass.draws + size - 1) / size;
    std::exception_ptr failure;
    for (std::uint64_t start = (pass.done + size - 1) / size; start < blocks;
         start += blocks_per_batch) {
        const std::uint64_t count = std::min(blocks_per_batch, blocks - start);
        std::vector<Result> results(count);
#pragma omp parallel for schedule(dynamic) num_threads(pass.threads)
        for (std::uint64_t i = 0; i < count; ++i) {
            try {
                const std::uint64_t first = (start + i) * size;
                results[i] = work(evaluate_draws(
                    pass.likelihood, pass.proposal, pass.numbers, first,
                    std::min(size, pass.draws - first), pass.draws_per_lot));
            } catch (...) {
#pragma omp critical(calibrate_block_failure)
                failure = std::current_exception();
            }
        }
        if (failure) std::rethrow_exception(failure);
        for (Result& result : results) consume(std::move(result));
        after_batch();
    }
}

}  // namespace taylorcal::calibrate
