#pragma once

#include "solver/sph/field.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace taylorcal::sph {

using SlotPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// What of the stencil's forces arrives at a block at one tick.
struct Arrivals {
    const Field& impulse;  ///< of a slot's stresses, if just renewed [ticks]
    float open;            ///< impulses up to this one have just been renewed
    float period;          ///< of the block's own moves [ticks]
};

/// Who moves when: local time steps in powers of two.
///
/// A cycle is 2^top ticks, between which and the next one all blocks are in step. A
/// block's stresses are renewed every 2^l ticks, with the largest l that its own sound
/// time allows, and act on its whole stencil as one impulse for that time: an
/// asynchronous variational integrator (Lew et al. 2003, doi 10.1007/s00205-002-0212-y),
/// which conserves momentum and energy as leapfrog does. Stresses that are held instead,
/// over the finer steps of neighbours, lag behind and pump energy. Particles move as
/// often as the most frequently renewed block of their stencil. Indices count within
/// Packing::active.
class Schedule {
  public:
    /// `stencils` lists for every active block those that share a pair of neighbours with
    /// it, and itself.
    Schedule(const Packing& packing, std::vector<std::vector<std::uint32_t>> stencils);

    /// Chooses the next cycle from the stable steps of the blocks [s].
    void plan(const std::vector<double>& stable);
    void shorten(double longest);  ///< the planned cycle [s]
    /// Fixes who moves when. Pairs of slots that may collide have to move together.
    void start(const SlotPairs& pairs);

    double tick() const { return tick_; }  ///< [s]
    std::uint32_t ticks() const { return 1u << top_; }
    double duration() const { return tick_ * ticks(); }             ///< of the cycle [s]
    double step(int level) const { return tick_ * (1u << level); }  ///< [s]

    /// The coarsest level of which a step begins with this tick, and one ends before it.
    int open_level(std::uint32_t tick) const;
    /// Blocks whose particles move, and whose stresses are renewed, at a level.
    const std::vector<std::uint32_t>& moving(int level) const {
        return moving_[static_cast<std::size_t>(level)];
    }
    const std::vector<std::uint32_t>& renewed(int level) const {
        return renewed_[static_cast<std::size_t>(level)];
    }
    int motion_level(std::size_t slot) const {
        return motion_[index_of_block_[slot / block_size]];
    }

    /// Whether the impulses of a block's stencil arrive all at once and for equal times.
    bool pulled_alike(std::uint32_t index, std::uint32_t tick) const {
        return pulled_alike_[index] &&
               (tick > 0 || (pulled_alike_before_[index] && shared_alike_[index]));
    }
    /// A renewed stress acts for the mean of its last step and its next one, as in any
    /// leapfrog: over the next one.
    float share(std::uint32_t index, std::uint32_t tick) const {
        return tick > 0 ? 1 : share_[index];
    }
    Arrivals arrivals(std::uint32_t index, std::uint32_t tick) const;

    /// Whether all of a block's stencil moves just when its stresses are renewed.
    bool moved_alike(std::uint32_t index) const { return moved_alike_[index]; }
    /// A bit for each level over whose steps a block's mean velocity is to be kept.
    std::uint32_t means_wanted(std::uint32_t index) const { return means_wanted_[index]; }

    static constexpr int highest_level = 7;

  private:
    /// Of a block's next step, with the tick [s].
    int level(std::size_t index, double stable, double tick) const;
    void choose_motion(const SlotPairs& pairs);
    void limit_lag(const SlotPairs& pairs);
    void share_steps();

    const Packing& packing_;
    std::vector<std::vector<std::uint32_t>> stencils_;
    std::vector<std::uint32_t> index_of_block_;
    double finest_ = 0;  // what a tick may be at most [s]
    double tick_ = 0;
    int top_ = 0;
    std::vector<int> renewal_;  // level of the stresses, by block
    std::vector<int> motion_;   // level of the particles
    std::vector<double> last_;  // step of the stresses in the cycle before [s]
    std::vector<float> share_;  // of the first impulse
    std::vector<bool> shared_alike_;
    std::vector<bool> pulled_alike_, pulled_alike_before_, moved_alike_;  // by block
    std::vector<std::uint32_t> means_wanted_;
    std::vector<std::vector<std::uint32_t>> moving_, renewed_;  // blocks, by level
    Field impulse_, first_impulse_;                             // [ticks]
};

}  // namespace taylorcal::sph
