#pragma once

#include "calibrate/prior_pass/draw_block.hpp"
#include "calibrate/prior_pass/running_result.hpp"
#include "calibrate/sampling/checkpoint.hpp"

#include <cstdint>
#include <functional>

namespace taylorcal::calibrate {

/// Runs a pass on several threads and adds its blocks to `result` in their order, so that
/// the bytes do not depend on the threads. A saved state with the same key is taken up
/// where it was and leads to the same bytes; one with another key is ignored. The last
/// state is saved too. `advance` is told of the draws as they are done, those of the
/// saved state first. Returns the draws that the saved state had.
std::uint64_t run_plain_pass(const PlainPass& pass, RunningResult& result, int threads,
                             const Checkpoint& checkpoint,
                             const std::function<void(std::uint64_t)>& advance = {});

}  // namespace taylorcal::calibrate
