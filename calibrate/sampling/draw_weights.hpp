#pragma once

#include "calibrate/likelihood/spread_levels.hpp"
#include "calibrate/sampling/draw_table.hpp"

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Importance weights of evaluated draws, with the likelihood raised to a power between 0
/// (prior) and 1 (posterior).
class DrawWeights {
  public:
    DrawWeights(const DrawTable& table, const SpreadLevels& levels, double power = 1);

    /// ln weight of each draw: ln [sum_g p_g prod_lots mean_m L_lot(k, m, g) / q].
    const Eigen::VectorXd& log_weights() const { return log_weights_; }
    double effective_size() const;
    /// Probability of each spread level given draw k.
    Eigen::VectorXd level_shares(Eigen::Index k) const;
    /// Probability of each own draw m of a lot given draw k and a spread level.
    Eigen::VectorXd own_shares(Eigen::Index k, std::size_t lot, Eigen::Index level) const;

  private:
    const DrawTable& table_;
    double power_;
    RowMatrix log_levels_;  // a row a draw, a column a level: ln of the sum's terms
    Eigen::VectorXd log_weights_;
};

}  // namespace taylorcal::calibrate
