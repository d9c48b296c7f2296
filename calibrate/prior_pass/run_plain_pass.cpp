#include "calibrate/prior_pass/run_plain_pass.hpp"

#include "common/hdf5_file.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

namespace taylorcal::calibrate {
namespace {

constexpr const char* checkpoint_schema = "taylorcal/plain_pass/1";

void save(const Checkpoint& checkpoint, RunningResult& result) {
    if (checkpoint.path.empty()) return;
    Hdf5Writer file(checkpoint.path);
    file.attribute("schema", checkpoint_schema);
    file.attribute("key", checkpoint.key);
    result.visit([&](const char* name, const std::vector<double>& values) {
        file.numbers(name, values);
    });
    file.numbers("pool", result.pool_numbers());
    file.close();
}

void load(const Checkpoint& checkpoint, RunningResult& result) {
    if (checkpoint.path.empty() || !std::filesystem::exists(checkpoint.path)) return;
    const Hdf5Reader file(checkpoint.path);
    file.expect_schema(checkpoint_schema);
    if (file.text_attribute("key") != checkpoint.key) return;
    result.visit([&](const char* name, std::vector<double>& values) {
        values = file.numbers(name);
    });
    result.restore_pool(file.numbers("pool"));
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
            save(checkpoint, result);
            saved = now;
        }
        if (advance) advance(draws);
    }
    return resumed;
}

}  // namespace taylorcal::calibrate
