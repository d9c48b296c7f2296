#include "calibrate/sampling/fit_proposal.hpp"

#include "calibrate/sampling/gaussian_mixture.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

constexpr double prior_share = 0.1;
constexpr std::size_t most_parts = 4;
constexpr double floor_of_spread = 1e-4;  // of the prior's width

/// Posterior weight of every own draw (row k M + m) of a lot, over all levels.
Eigen::VectorXd own_weights(const DrawTable& table, const DrawWeights& weights,
                            const Eigen::VectorXd& of_draws, std::size_t lot) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(table.draws() * table.inner);
    for (Eigen::Index k = 0; k < table.draws(); ++k) {
        if (of_draws(k) <= 0) continue;
        const Eigen::VectorXd levels = weights.level_shares(k);
        for (Eigen::Index g = 0; g < levels.size(); ++g)
            if (levels(g) > 1e-6)
                all.segment(k * table.inner, table.inner) +=
                    of_draws(k) * levels(g) * weights.own_shares(k, lot, g);
    }
    return all;
}

/// Weighted least squares of a lot's own parameters on the shared ones about `centre`.
Proposal::Regression regress(const DrawTable& table, std::size_t lot,
                             const Eigen::VectorXd& weights,
                             const Eigen::VectorXd& centre) {
    const Eigen::Index shared = table.shared.cols();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(shared + 1, shared + 1);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(shared + 1, table.own[lot].cols());
    Eigen::VectorXd row(shared + 1);
    const auto design = [&](Eigen::Index i) {
        row(0) = 1;
        row.tail(shared) = table.shared.row(i / table.inner).transpose() - centre;
    };
    for (Eigen::Index i = 0; i < weights.size(); ++i) {
        if (weights(i) <= 0) continue;
        design(i);
        normal += weights(i) * row * row.transpose();
        right += weights(i) * row * table.own[lot].row(i);
    }
    const double total = weights.sum();
    // A slope needs spread of the shared parameters; the ridge keeps it tame without.
    normal.diagonal().tail(shared).array() += total * floor_of_spread * floor_of_spread;
    const Eigen::MatrixXd solution = normal.ldlt().solve(right);
    Eigen::MatrixXd covariance =
        Eigen::MatrixXd::Zero(table.own[lot].cols(), table.own[lot].cols());
    for (Eigen::Index i = 0; i < weights.size(); ++i) {
        if (weights(i) <= 0) continue;
        design(i);
        const Eigen::VectorXd rest =
            table.own[lot].row(i).transpose() - solution.transpose() * row;
        covariance += weights(i) / total * rest * rest.transpose();
    }
    return {
        solution.bottomRows(shared).transpose(),
        HeavyTail(solution.row(0).transpose(), safe_root(covariance, floor_of_spread))};
}

}  // namespace

Proposal fit_proposal(const DrawTable& table, const DrawWeights& weights,
                      const DrawNumbers& numbers) {
    const double largest = weights.log_weights().maxCoeff();
    Eigen::VectorXd w = (weights.log_weights().array() - largest).exp();
    w /= w.sum();
    const double per_part = 20.0 * static_cast<double>(table.shared.cols() + 1);
    const auto affordable = static_cast<std::size_t>(weights.effective_size() / per_part);
    std::vector<double> picks;
    for (std::size_t c = 0; c < most_parts; ++c)
        picks.push_back(numbers(DrawNumbers::Purpose::start, c));
    const GaussianMixture mixture = fit_gaussian_mixture(
        table.shared, w, std::clamp<std::size_t>(affordable, 1, most_parts), picks);

    std::vector<double> part_weights;
    std::vector<HeavyTail> parts;
    for (const auto& part : mixture.parts) {
        part_weights.push_back(part.weight);
        parts.emplace_back(part.mean, safe_root(part.covariance, floor_of_spread));
    }
    std::vector<std::vector<Proposal::Regression>> regressions(table.own.size());
    for (std::size_t lot = 0; lot < table.own.size(); ++lot) {
        if (table.own[lot].cols() == 0) continue;
        const Eigen::VectorXd of_rows = own_weights(table, weights, w, lot);
        for (std::size_t c = 0; c < parts.size(); ++c) {
            Eigen::VectorXd mine = of_rows;
            for (Eigen::Index i = 0; i < mine.size(); ++i)
                mine(i) *= mixture.responsibilities(i / table.inner,
                                                    static_cast<Eigen::Index>(c));
            regressions[lot].push_back(regress(table, lot, mine, parts[c].mean()));
        }
    }
    const bool nested = !table.own.empty() && table.own.front().cols() > 0;
    if (!nested) regressions.clear();
    return {Mixture(prior_share, part_weights, std::move(parts)), std::move(regressions),
            prior_share};
}

}  // namespace taylorcal::calibrate
