#pragma once

#include "calibrate/posterior/maps.hpp"
#include "calibrate/posterior/plain_findings.hpp"
#include "calibrate/prior_pass/draw_block.hpp"
#include "calibrate/sampling/draw_numbers.hpp"
#include "calibrate/sampling/draw_pool.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Ranges of the maps in the unit cube, by parameter.
struct MapRanges {
    std::vector<double> low, high;
};

/// What a pass accumulates: sums of weights, moments, histograms, a pool of draws. Its
/// size does not depend on the number of draws, blocks enter in the order of their
/// numbers, and it can be saved between any two and taken up again.
class RunningResult {
  public:
    RunningResult(const Pruning& pruning, const ParameterSpace& space,
                  const SpreadLevels& levels, MapRanges ranges, DrawSequence sequence,
                  std::uint64_t seed, std::size_t pool_capacity);

    void add(const DrawBlock& block);
    std::uint64_t next_block() const { return count(next_block_at); }
    std::uint64_t draws() const { return count(draws_at); }
    std::uint64_t rows_seen() const { return count(rows_at); }

    double log_evidence() const;
    /// Monte-Carlo error: from the weights for random draws, from the scatter between
    /// replicates for Sobol's.
    double log_evidence_sd() const;
    double effective_size() const;
    /// Upper bound of the posterior mass of all that was dropped.
    double dropped_bound() const;
    WeightedDraws pool() const { return pool_.weighted(); }
    /// Densities over the ranges, smoothed as far as the number of draws asks for.
    Maps maps() const;
    /// At 1e4, 1e5 ... draws (at the end of the block that holds it) and now.
    std::vector<Progression> convergence() const;

    /// Names and contents of all sums, for saving and loading.
    template <class Visit>
    void visit(const Visit& visit_one) {
        visit_one("counts", counts_);
        visit_one("sums", sums_);
        visit_one("replicate_sums", replicate_sums_);
        visit_one("replicate_draws", replicate_draws_);
        visit_one("moments", moments_);
        visit_one("level_sums", level_sums_);
        visit_one("histograms_1d", singles_);
        visit_one("histograms_2d", pairs_);
        visit_one("histograms_with_levels", with_levels_);
        visit_one("decades", decades_);
    }
    std::vector<double> pool_numbers() const { return pool_.numbers(); }
    void restore_pool(const std::vector<double>& numbers) {
        pool_.restore(numbers, dimensions_);
    }

  private:
    enum CountAt { next_block_at, draws_at, rows_at };
    enum SumAt { weight_at, square_at, dropped_at };
    static constexpr std::size_t cells_1d = 120, cells_2d = 96;

    std::uint64_t count(CountAt at) const {
        return static_cast<std::uint64_t>(counts_[at]);
    }
    void add_draw(const DrawBlock& block, std::size_t i);
    void add_to_maps(const std::vector<double>& unit, double weight);
    void add_to_pool(std::uint64_t number, const std::vector<double>& unit,
                     double log_weight);
    Progression now() const;
    MapAxis axis(std::size_t d, std::size_t cells, int dimensions) const;

    const Pruning& pruning_;
    const ParameterSpace& space_;
    const SpreadLevels& levels_;
    MapRanges ranges_;
    DrawSequence sequence_;
    DrawNumbers numbers_;
    std::size_t dimensions_;
    DrawPool pool_;
    // Counts are whole numbers below 2^53; weights are relative to the threshold.
    std::vector<double> counts_, sums_, replicate_sums_, replicate_draws_, moments_,
        level_sums_, singles_, pairs_, with_levels_, decades_;
    std::vector<double> terms_, shares_;  // of one draw
};

}  // namespace taylorcal::calibrate
