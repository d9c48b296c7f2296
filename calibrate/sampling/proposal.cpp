#include "calibrate/sampling/proposal.hpp"

namespace taylorcal::calibrate {

Proposal::Proposal(const ParameterSpace& space)
    : shared_(static_cast<Eigen::Index>(space.shared_count())),
      own_dimension_(static_cast<Eigen::Index>(space.per_lot_count())) {}

Proposal::Proposal(Mixture shared, std::vector<std::vector<Regression>> regressions,
                   double prior_share)
    : shared_(std::move(shared)),
      own_dimension_(
          regressions.empty() ? 0 : regressions.front().front().bell.mean().size()),
      regressions_(std::move(regressions)),
      prior_share_(prior_share) {}

Eigen::VectorXd Proposal::features(const Eigen::VectorXd& difference) {
    const Eigen::Index n = difference.size();
    Eigen::VectorXd terms(1 + n + n * (n + 1) / 2);
    terms(0) = 1;
    terms.segment(1, n) = difference;
    Eigen::Index at = 1 + n;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j) terms(at++) = difference(i) * difference(j);
    return terms;
}

Mixture Proposal::own(std::size_t lot, const Eigen::VectorXd& shared) const {
    if (is_prior() || own_dimension_ == 0) return Mixture(own_dimension_);
    // Parts that hardly hold the shared parameters would only cost time.
    constexpr double smallest_share = 0.02;
    const std::vector<double> responsible = shared_.responsibilities(shared);
    std::vector<double> shares;
    std::vector<HeavyTail> bells;
    for (std::size_t part = 0; part < responsible.size(); ++part) {
        if (responsible[part] < smallest_share) continue;
        const Regression& regression = regressions_[lot][part];
        const Eigen::VectorXd centre = regression.coefficients.transpose() *
                                       features(shared - shared_.parts()[part].mean());
        // Far from the part the parabola may leave the cube, where nothing is found.
        bells.push_back(regression.bell.moved_to(centre.cwiseMax(0.0).cwiseMin(1.0)));
        shares.push_back(responsible[part]);
    }
    return Mixture(prior_share_, std::move(shares), std::move(bells));
}

}  // namespace taylorcal::calibrate
