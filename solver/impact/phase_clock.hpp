#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace taylorcal::impact {

/// What a run spends its time on.
enum class Phase { gradients, plasticity, forces, motion };
inline constexpr std::array<const char*, 4> phase_names = {"gradients", "plasticity",
                                                           "forces", "motion"};

/// Shares of a run's time by phase, from one round of steps in thirty-two: reading the
/// clock around every block of grains would cost as much as what is measured.
class PhaseClock {
  public:
    /// Begins a round of steps.
    void begin_round() {
        sampling_ = rounds_++ % 32 == 0;
        if (sampling_) last_ = Clock::now();
    }
    /// What has happened since the last mark was `phase`.
    void mark(Phase phase) {
        if (!sampling_) return;
        const Clock::time_point now = Clock::now();
        spent_[static_cast<std::size_t>(phase)] += now - last_;
        last_ = now;
    }
    /// Share of each phase, in the order of `phase_names`; they add up to one.
    std::array<double, 4> shares() const {
        double total = 0;
        for (const Clock::duration& spent : spent_)
            total += static_cast<double>(spent.count());
        std::array<double, 4> shares{};
        for (std::size_t i = 0; i < shares.size() && total > 0; ++i)
            shares[i] = static_cast<double>(spent_[i].count()) / total;
        return shares;
    }

  private:
    using Clock = std::chrono::steady_clock;
    bool sampling_ = false;
    std::uint64_t rounds_ = 0;
    Clock::time_point last_;
    std::array<Clock::duration, 4> spent_{};
};

}  // namespace taylorcal::impact
