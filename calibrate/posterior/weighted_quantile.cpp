#include "calibrate/posterior/weighted_quantile.hpp"

#include <algorithm>
#include <numeric>

namespace taylorcal::calibrate {

WeightedQuantile::WeightedQuantile(const Eigen::VectorXd& values,
                                   const Eigen::VectorXd& weights) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(
        order.begin(), order.end(),
        [&values](Eigen::Index a, Eigen::Index b) { return values(a) < values(b); });
    const double total = weights.sum();
    double reached = 0;
    for (const Eigen::Index i : order) {
        values_.push_back(values(i));
        shares_.push_back((reached + 0.5 * weights(i)) / total);
        reached += weights(i);
    }
}

WeightedQuantile::WeightedQuantile(const Eigen::VectorXd& values)
    : WeightedQuantile(values, Eigen::VectorXd::Ones(values.size())) {}

double WeightedQuantile::operator()(double share) const {
    const auto above = std::upper_bound(shares_.begin(), shares_.end(), share);
    if (above == shares_.begin()) return values_.front();
    if (above == shares_.end()) return values_.back();
    const auto i = static_cast<std::size_t>(above - shares_.begin());
    const double part = (share - shares_[i - 1]) / (shares_[i] - shares_[i - 1]);
    return values_[i - 1] + part * (values_[i] - values_[i - 1]);
}

}  // namespace taylorcal::calibrate
