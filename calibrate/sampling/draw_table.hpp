#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"
#include "calibrate/sampling/draw_numbers.hpp"
#include "calibrate/sampling/proposal.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Evaluated draws, nested because the likelihood factorises over lots once the shared
/// parameters are given: for each draw k of the shared parameters, M draws of every lot's
/// own ones. With L_k = prod_lots mean_m L_lot(k, m) the mean of L_k is an unbiased
/// estimate of the evidence, and each k stands for M^lots combined draws.
struct DrawTable {
    std::uint64_t first = 0;     ///< number of the first draw
    Eigen::Index inner = 1;      ///< M
    RowMatrix shared;            ///< a row a draw, coordinates of the unit cube
    Eigen::VectorXd log_shared;  ///< ln(prior / proposal); -inf outside the cube
    std::vector<RowMatrix> own;  ///< by lot: row k M + m
    std::vector<Eigen::VectorXd> log_own;
    std::vector<RowMatrix>
        log_likelihood;  ///< by lot: row k M + m, column = spread level

    Eigen::Index draws() const { return shared.rows(); }
};

/// Draws `first` to `first + count` of a pass. A lot's own draws are stratified (Latin
/// hypercube through the proposal's quantiles), which leaves their mean unbiased.
DrawTable evaluate_draws(const LotLikelihood& likelihood, const Proposal& proposal,
                         const DrawNumbers& numbers, std::uint64_t first,
                         std::uint64_t count, std::uint64_t draws_per_lot);

/// Joins tables of consecutive draws.
DrawTable join(const std::vector<DrawTable>& tables);

}  // namespace taylorcal::calibrate
