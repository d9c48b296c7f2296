#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"

#include <cstddef>
#include <vector>

namespace taylorcal::calibrate {

/// When a draw may be dropped before all rows have been seen.
///
/// ln L of a draw at spread level g is ceiling_g - factor_g Q, where Q >= 0, its misfit,
/// sums r^T C^-1 r / 2 over the rows, and the ceiling, that of a perfect fit, has all
/// ln det C and the level's prior mass. After some rows Q can only grow, so that the sum
/// seen so far bounds L from above, with every level of the spread. A draw is dropped
/// once that bound is below a threshold, which is chosen as `dropped_share` of the mean
/// likelihood: all dropped draws together then hold at most this share of the posterior.
/// Levels whose ceiling alone is below the threshold are not computed at all.
class Pruning {
  public:
    /// `log_mean`: estimate of ln of the mean likelihood (of ln Z). An error of the
    /// estimate shifts the threshold; `log_dropped_bound` tells what it came to.
    Pruning(const LotLikelihood& likelihood, double log_mean, double dropped_share);

    /// The levels whose covariances make the misfits; one where the covariances of all
    /// levels are proportional.
    const std::vector<std::size_t>& misfit_levels() const { return misfit_levels_; }
    std::size_t misfits() const { return misfit_levels_.size(); }

    /// How far (in ln L) below the threshold the bound of a draw with these misfits is;
    /// not above zero: it must be kept. `misfit(m)` gives the m-th.
    template <class Misfit>
    float depth(const Misfit& misfit) const {
        float least = rates_[0] * (misfit(0) - limits_[0]);
        for (std::size_t m = 1; m < limits_.size(); ++m)
            least = std::min(least, rates_[m] * (misfit(m) - limits_[m]));
        return least;
    }
    /// ln of prior mass times L for each computed level.
    template <class Misfit>
    void log_levels(const Misfit& misfit, std::vector<double>& terms) const {
        terms.resize(levels_.size());
        for (std::size_t i = 0; i < levels_.size(); ++i)
            terms[i] = levels_[i].ceiling - levels_[i].factor * misfit(levels_[i].misfit);
    }
    /// The level that term i of `log_levels` belongs to.
    std::size_t level(std::size_t i) const { return levels_[i].level; }
    std::size_t levels() const { return levels_.size(); }

    double log_threshold() const { return log_threshold_; }
    /// ln of a bound of the likelihood that levels left out had, for any draw.
    double log_left_out() const { return log_left_out_; }

  private:
    struct Level {
        std::size_t level, misfit;
        double ceiling, factor;
    };
    void use_one_misfit(std::size_t level_count);
    void use_own_misfits();

    double log_threshold_, log_left_out_;
    std::vector<double> ceilings_;  // of all levels
    std::vector<double> factors_;   // of all levels, if proportional
    std::vector<Level> levels_;
    std::vector<std::size_t> misfit_levels_;
    std::vector<float> limits_, rates_;
};

}  // namespace taylorcal::calibrate
