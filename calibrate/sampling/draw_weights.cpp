#include "calibrate/sampling/draw_weights.hpp"

#include "calibrate/sampling/log_sum.hpp"

#include <cmath>

namespace taylorcal::calibrate {
namespace {

/// ln of the mean over the own draws of L^power prior/proposal, for each level.
Eigen::RowVectorXd log_means(const DrawTable& table, std::size_t lot, Eigen::Index k,
                             double power) {
    const RowMatrix& log_likelihood = table.log_likelihood[lot];
    Eigen::RowVectorXd means(log_likelihood.cols());
    for (Eigen::Index g = 0; g < means.size(); ++g) {
        LogSum sum;
        for (Eigen::Index m = 0; m < table.inner; ++m) {
            const Eigen::Index row = k * table.inner + m;
            sum.add(power * log_likelihood(row, g) + table.log_own[lot](row));
        }
        means(g) = sum.value() - std::log(static_cast<double>(table.inner));
    }
    return means;
}

/// exp and normalise.
Eigen::VectorXd shares_of(const Eigen::VectorXd& logs) {
    const Eigen::VectorXd shares = (logs.array() - logs.maxCoeff()).exp();
    return shares / shares.sum();
}

}  // namespace

DrawWeights::DrawWeights(const DrawTable& table, const SpreadLevels& levels, double power)
    : table_(table),
      power_(power),
      log_levels_(table.draws(), static_cast<Eigen::Index>(levels.values.size())),
      log_weights_(table.draws()) {
    const Eigen::Map<const Eigen::RowVectorXd> log_mass(levels.log_mass.data(),
                                                        log_levels_.cols());
    for (Eigen::Index k = 0; k < table.draws(); ++k) {
        log_levels_.row(k) = log_mass.array() + table.log_shared(k);
        for (std::size_t lot = 0; lot < table.own.size(); ++lot)
            log_levels_.row(k) += log_means(table, lot, k, power);
        LogSum sum;
        for (Eigen::Index g = 0; g < log_levels_.cols(); ++g) sum.add(log_levels_(k, g));
        log_weights_(k) = sum.value();
    }
}

double DrawWeights::effective_size() const {
    LogSum sum;
    for (const double log_weight : log_weights_) sum.add(log_weight);
    return sum.effective_size();
}

Eigen::VectorXd DrawWeights::level_shares(Eigen::Index k) const {
    return shares_of(log_levels_.row(k).transpose());
}

Eigen::VectorXd DrawWeights::own_shares(Eigen::Index k, std::size_t lot,
                                        Eigen::Index level) const {
    const Eigen::Index from = k * table_.inner;
    return shares_of(
        power_ * table_.log_likelihood[lot].col(level).segment(from, table_.inner) +
        table_.log_own[lot].segment(from, table_.inner));
}

}  // namespace taylorcal::calibrate
