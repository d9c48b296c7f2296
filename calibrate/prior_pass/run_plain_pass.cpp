#include "calibrate/prior_pass/run_plain_pass.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

namespace taylorcal::calibrate {
namespace {

void save_result(const Checkpoint& checkpoint, RunningResult& result) {
    NamedNumbers all = {{"pool", result.pool_numbers()}};
    result.visit([&all](const char* name, const std::vector<double>& values) {
        all[name] = values;
    });
    save(checkpoint, all);
}

void load(const Checkpoint& checkpoint, RunningResult& result) {
    const auto all = saved(checkpoint);
    if (!all) return;
    result.visit([&all](const char* name, std::vector<double>& values) {
        values = all->at(name);
    });
    result.restore_pool(all->at("pool"));
}

}  // namespace

std::uint64_t run_plain_pass(const PlainPass& pass, RunningResult& result, int threads,
                             const Checkpoint& checkpoint,
                             const std::function<void(std::uint64_t)>& advance) {
    using Clock = std::chrono::steady_clock;
    constexpr std::uint64_t blocks_per_batch = 32;
    load(checkpoint, result);
    const std::uint64_t resumed = result.draws();
    if (resumed > 0 && advance) advance(resumed);
    const std::uint64_t blocks =
        (pass.draws + UnitSequence::block - 1) / UnitSequence::block;
    std::exception_ptr failure;
    auto saved = Clock::now();
    while (result.next_block() < blocks) {
        const std::uint64_t first = result.next_block();
        const std::uint64_t count = std::min(blocks_per_batch, blocks - first);
        std::vector<DrawBlock> done(count);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
        for (std::uint64_t i = 0; i < count; ++i) {
            try {
                done[i] = evaluate_block(pass, first + i);
            } catch (...) {
#pragma omp critical(calibrate_plain_block_failure)
                failure = std::current_exception();
            }
        }
        if (failure) std::rethrow_exception(failure);
        std::uint64_t draws = 0;
        for (const DrawBlock& block : done) {
            result.add(block);
            draws += block.draws;
        }
        const auto now = Clock::now();
        if (std::chrono::duration<double>(now - saved).count() >= checkpoint.seconds ||
            result.next_block() == blocks) {
            save_result(checkpoint, result);
            saved = now;
        }
        if (advance) advance(draws);
    }
    return resumed;
}

}  // namespace taylorcal::calibrate
