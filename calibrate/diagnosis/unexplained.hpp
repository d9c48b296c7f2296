#pragma once

#include "calibrate/diagnosis/refit.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// Where the rest of the misfit is, and which state of the metal it follows.
struct Unexplained {
    struct Cell {
        std::string shape, size, velocity_third;
        double mean_whitened = 0;
        std::size_t n = 0;
    };
    struct Correlation {
        std::string descriptor, size;
        double rank_correlation = 0;
        double p = 1;  ///< over all sizes of the descriptor
    };
    std::vector<Cell> pattern;
    std::vector<Correlation> correlations;  ///< the strongest size of each descriptor
};

/// `residual`: whitened and projected.
Unexplained describe_unexplained(const DiagnosisProblem& problem,
                                 const Eigen::VectorXd& residual);

/// Spearman's rank correlation; ties get their mean rank.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace taylorcal::calibrate
