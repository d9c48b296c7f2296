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

Mixture Proposal::own(std::size_t lot, const Eigen::VectorXd& shared) const {
    if (is_prior() || own_dimension_ == 0) return Mixture(own_dimension_);
    std::vector<HeavyTail> bells;
    for (std::size_t part = 0; part < shared_.parts().size(); ++part) {
        const Regression& regression = regressions_[lot][part];
        bells.push_back(regression.bell.moved_to(
            regression.bell.mean() +
            regression.slope * (shared - shared_.parts()[part].mean())));
    }
    return Mixture(prior_share_, shared_.responsibilities(shared), std::move(bells));
}

}  // namespace taylorcal::calibrate
