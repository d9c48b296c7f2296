#include "solver/sph/schedule.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace taylorcal::sph {

namespace {

constexpr double longest_growth = 1.05;  // of the finest step from one cycle to the next
constexpr int tick_candidates = 8;       // within the factor of two between levels
// Metal at rest bears a step near the longest for ever, but not one that goes to and fro,
// as waves would let it that change by a hair what is stable: a specimen's rear became
// hot. So a step that is longer than the last, by more than the finest grows and less
// than candidates differ, must leave some room.
constexpr double lengthening = 1.06;
constexpr double room_to_lengthen = 1.05;
// Levels by which the stresses of blocks that may collide are renewed less often than
// they move. A collision changes velocities at once. Between two kicks of a stress, the
// work that is counted by mean velocities is then not what the kicks do: with no limit,
// heads that fold gain up to a per cent of energy.
constexpr int contact_lag = 1;

}  // namespace

Schedule::Schedule(const Packing& packing,
                   std::vector<std::vector<std::uint32_t>> stencils)
    : packing_(packing),
      stencils_(std::move(stencils)),
      index_of_block_(packing.slots / block_size),
      renewal_(stencils_.size()),
      motion_(stencils_.size()),
      last_(stencils_.size()),
      share_(stencils_.size()),
      shared_alike_(stencils_.size()),
      pulled_alike_(stencils_.size(), true),
      pulled_alike_before_(stencils_.size(), true),
      moved_alike_(stencils_.size(), true),
      means_wanted_(stencils_.size()),
      moving_(highest_level + 1),
      renewed_(highest_level + 1),
      impulse_(packing.slots),
      first_impulse_(packing.slots) {
    for (std::size_t i = 0; i < packing.active.size(); ++i) {
        index_of_block_[packing.active[i]] = static_cast<std::uint32_t>(i);
    }
}

int Schedule::level(std::size_t index, double stable, double tick) const {
    const int longest = std::clamp(std::ilogb(stable / tick), 0, highest_level);
    const double step = std::ldexp(tick, longest);
    const bool lengthens = last_[index] > 0 && step > lengthening * last_[index];
    return lengthens && stable < room_to_lengthen * step ? std::max(longest - 1, 0)
                                                         : longest;
}

void Schedule::plan(const std::vector<double>& stable) {
    const double least = *std::min_element(stable.begin(), stable.end());
    finest_ = finest_ > 0 ? std::min(least, longest_growth * finest_) : least;
    // A somewhat finer tick may let most blocks take steps nearer to what they can.
    double lowest_cost = INFINITY;
    for (int c = 0; c < tick_candidates; ++c) {
        const double tick =
            finest_ * std::exp2(-static_cast<double>(c) / tick_candidates);
        double cost = 0;
        for (std::size_t i = 0; i < stable.size(); ++i)
            cost += std::ldexp(1 / tick, -level(i, stable[i], tick));
        if (cost >= lowest_cost) continue;
        lowest_cost = cost;
        tick_ = tick;
    }
    for (std::size_t i = 0; i < stable.size(); ++i)
        renewal_[i] = level(i, stable[i], tick_);
    top_ = *std::max_element(renewal_.begin(), renewal_.end());
}

void Schedule::shorten(double longest) {
    if (duration() > longest) tick_ = longest / ticks();
}

void Schedule::choose_motion(const SlotPairs& pairs) {
    for (std::size_t i = 0; i < stencils_.size(); ++i) {
        motion_[i] = highest_level;
        for (const std::uint32_t j : stencils_[i]) {
            motion_[i] = std::min(motion_[i], renewal_[j]);
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [i, j] : pairs) {
            int& a = motion_[index_of_block_[i / block_size]];
            int& b = motion_[index_of_block_[j / block_size]];
            changed = changed || a != b;
            a = b = std::min(a, b);
        }
    }
}

void Schedule::limit_lag(const SlotPairs& pairs) {
    for (const auto& [a, b] : pairs) {
        for (const std::size_t slot : {a, b}) {
            const std::uint32_t i = index_of_block_[slot / block_size];
            renewal_[i] = std::min(renewal_[i], motion_[i] + contact_lag);
        }
    }
}

void Schedule::share_steps() {
    for (std::size_t i = 0; i < stencils_.size(); ++i) {
        const double next = step(renewal_[i]);
        share_[i] = static_cast<float>((last_[i] + next) / (2 * next));
        last_[i] = next;
        const std::size_t block = packing_.active[i];
        impulse_[block] = static_cast<float>(1u << renewal_[i]);
        first_impulse_[block] = share_[i] * impulse_[block];
    }
}

void Schedule::start(const SlotPairs& pairs) {
    std::swap(pulled_alike_, pulled_alike_before_);
    choose_motion(pairs);
    if (!pairs.empty()) {
        limit_lag(pairs);
        choose_motion(pairs);
    }
    share_steps();
    for (auto* lists : {&moving_, &renewed_}) {
        for (auto& list : *lists) list.clear();
    }
    std::fill(means_wanted_.begin(), means_wanted_.end(), 0u);
    for (std::uint32_t i = 0; i < stencils_.size(); ++i) {
        moving_[static_cast<std::size_t>(motion_[i])].push_back(i);
        renewed_[static_cast<std::size_t>(renewal_[i])].push_back(i);
        bool pulled = true, shared = true, moved = true;
        for (const std::uint32_t j : stencils_[i]) {
            pulled = pulled && motion_[j] == motion_[i] && renewal_[j] == motion_[i];
            shared = shared && share_[j] == share_[i];
            moved = moved && motion_[j] == renewal_[i];
        }
        pulled_alike_[i] = pulled;
        shared_alike_[i] = shared;
        moved_alike_[i] = moved;
        if (moved) continue;
        for (const std::uint32_t j : stencils_[i]) {
            means_wanted_[j] |= 1u << renewal_[i];
        }
    }
}

int Schedule::open_level(std::uint32_t tick) const {
    return std::min(top_, std::countr_zero(tick));
}

Arrivals Schedule::arrivals(std::uint32_t index, std::uint32_t tick) const {
    const bool first = tick == 0;
    return {first ? first_impulse_ : impulse_,
            first ? INFINITY : static_cast<float>(1u << open_level(tick)),
            static_cast<float>(1u << motion_[index])};
}

}  // namespace taylorcal::sph
