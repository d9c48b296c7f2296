#pragma once

#include "calibrate/sampling/adapt.hpp"
#include "calibrate/sampling/checkpoint.hpp"
#include "calibrate/sampling/draw_pool.hpp"
#include "calibrate/sampling/log_sum.hpp"

#include <chrono>
#include <cstdint>

namespace taylorcal::calibrate {

/// How far a sampling has come: the search for a proposal, then the sums over the last
/// pass. It can be saved after any pass of the search and between any two blocks of the
/// last pass, and is taken up again with the same bytes.
class SamplingState {
  public:
    SamplingState(const ParameterSpace& space, std::size_t pool_capacity);

    Adaptation adaptation;
    std::uint64_t draws = 0;  ///< of the last pass that are done
    LogSum weights;
    DrawPool pool;

    /// Takes up what was saved, if it is of this sampling, and says from where it goes
    /// on. `all`: draws of the last pass.
    void load(const Checkpoint& checkpoint, std::uint64_t all);
    /// Saves when the checkpoint's time has come, or `now`.
    void save(const Checkpoint& checkpoint, bool now);

  private:
    std::size_t dimensions_;
    std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();
};

}  // namespace taylorcal::calibrate
