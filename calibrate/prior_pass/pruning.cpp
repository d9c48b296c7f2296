#include "calibrate/prior_pass/pruning.hpp"

#include "calibrate/sampling/log_sum.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::calibrate {
namespace {

/// Factor of r^T C^-1 r at each level against the first, if it is the same for all rows;
/// else nothing.
std::vector<double> common_factors(const LotLikelihood& likelihood) {
    std::vector<double> factors(likelihood.levels().values.size(), 1);
    for (std::size_t g = 1; g < factors.size(); ++g) {
        factors[g] = 0;
        for (std::size_t lot = 0; lot < likelihood.space().lot_count(); ++lot) {
            for (const LotLikelihood::Row& row : likelihood.rows(lot)) {
                const Eigen::MatrixXd first = row.likelihood.inverse_root(0);
                const Eigen::MatrixXd root = row.likelihood.inverse_root(g);
                if (factors[g] == 0) factors[g] = root(0, 0) / first(0, 0);
                if (!root.isApprox(factors[g] * first, 1e-9)) return {};
            }
        }
        factors[g] *= factors[g];
    }
    return factors;
}

double log_sum(const std::vector<double>& terms) {
    LogSum sum;
    for (const double term : terms) sum.add(term);
    return sum.value();
}

}  // namespace

Pruning::Pruning(const LotLikelihood& likelihood, double log_mean, double dropped_share)
    : log_threshold_(log_mean + std::log(dropped_share)),
      log_left_out_(-std::numeric_limits<double>::infinity()),
      ceilings_(likelihood.levels().log_mass),
      factors_(common_factors(likelihood)) {
    for (std::size_t lot = 0; lot < likelihood.space().lot_count(); ++lot)
        for (const LotLikelihood::Row& row : likelihood.rows(lot))
            for (std::size_t g = 0; g < ceilings_.size(); ++g)
                ceilings_[g] += row.likelihood.log_norm(g);
    if (ceilings_.size() > 1 && !factors_.empty())
        use_one_misfit(ceilings_.size());
    else
        use_own_misfits();
}

void Pruning::use_own_misfits() {
    const double share = std::log(static_cast<double>(ceilings_.size()));
    LogSum left_out;
    for (std::size_t g = 0; g < ceilings_.size(); ++g) {
        const double room = ceilings_[g] - (log_threshold_ - share);
        if (room <= 0) {
            left_out.add(ceilings_[g]);
            continue;
        }
        levels_.push_back({g, misfit_levels_.size(), ceilings_[g], 1});
        misfit_levels_.push_back(g);
        limits_.push_back(static_cast<float>(room));
        rates_.push_back(1);
    }
    log_left_out_ = left_out.value();
}

void Pruning::use_one_misfit(std::size_t level_count) {
    misfit_levels_ = {0};
    double slowest = factors_[0];
    for (std::size_t g = 0; g < level_count; ++g) {
        levels_.push_back({g, 0, ceilings_[g], factors_[g]});
        slowest = std::min(slowest, factors_[g]);
    }
    // The bound falls as the misfit rises: bisection for where it meets the threshold.
    std::vector<double> terms;
    const auto bound = [&](double misfit) {
        log_levels([misfit](std::size_t) { return misfit; }, terms);
        return log_sum(terms);
    };
    double low = 0, high = 1;
    while (bound(high) > log_threshold_ && high < 1e300) high *= 2;
    constexpr int halvings = 200;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (bound(middle) > log_threshold_ ? low : high) = middle;
    }
    limits_ = {static_cast<float>(high)};
    rates_ = {static_cast<float>(slowest)};
}

}  // namespace taylorcal::calibrate
