#include "calibrate/sampling/fit_proposal.hpp"

#include "calibrate/sampling/gaussian_mixture.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

constexpr double prior_share = 0.1;
constexpr std::size_t most_parts = 24;
constexpr double negligible = 1e-12;  // weight of a draw

/// Posterior moments of a lot's own parameters given each draw of the shared ones.
struct OwnMoments {
    RowMatrix mean;        // a row a draw
    RowMatrix covariance;  // a row a draw, the matrix row by row
};

OwnMoments own_moments(const DrawTable& table, const DrawWeights& weights,
                       const Eigen::VectorXd& of_draws, std::size_t lot) {
    const Eigen::Index own = table.own[lot].cols();
    OwnMoments moments{RowMatrix::Zero(table.draws(), own),
                       RowMatrix::Zero(table.draws(), own * own)};
    for (Eigen::Index k = 0; k < table.draws(); ++k) {
        if (of_draws(k) < negligible) continue;
        const Eigen::VectorXd levels = weights.level_shares(k);
        Eigen::VectorXd shares = Eigen::VectorXd::Zero(table.inner);
        for (Eigen::Index g = 0; g < levels.size(); ++g)
            if (levels(g) > 1e-4) shares += levels(g) * weights.own_shares(k, lot, g);
        shares /= shares.sum();
        const RowMatrix points = table.own[lot].middleRows(k * table.inner, table.inner);
        moments.mean.row(k) = shares.transpose() * points;
        const RowMatrix centred = points.rowwise() - moments.mean.row(k);
        const RowMatrix covariance = centred.transpose() * shares.asDiagonal() * centred;
        moments.covariance.row(k) =
            Eigen::Map<const Eigen::RowVectorXd>(covariance.data(), own * own);
    }
    return moments;
}

/// Weighted least squares of a lot's own parameters on the shared ones; a row of
/// `features` for each draw.
Proposal::Regression regress(const RowMatrix& features, const OwnMoments& moments,
                             const Eigen::VectorXd& weights) {
    const Eigen::Index own = moments.mean.cols();
    Eigen::MatrixXd normal = features.transpose() * weights.asDiagonal() * features;
    // Terms need spread of the shared parameters; the ridge keeps them tame without.
    normal.diagonal().array() += weights.sum() * floor_of_spread * floor_of_spread;
    const Eigen::MatrixXd coefficients =
        normal.ldlt().solve(features.transpose() * weights.asDiagonal() * moments.mean);
    const RowMatrix rest = moments.mean - features * coefficients;
    const RowMatrix within = weights.transpose() * moments.covariance;
    const Eigen::MatrixXd covariance =
        (Eigen::Map<const RowMatrix>(within.data(), own, own) +
         RowMatrix(rest.transpose() * weights.asDiagonal() * rest)) /
        weights.sum();
    return {coefficients, HeavyTail(Eigen::VectorXd::Zero(own),
                                    safe_root(covariance, floor_of_spread))};
}

/// The regressions of all lots (outer) near every part (inner).
std::vector<std::vector<Proposal::Regression>> regress_lots(
    const DrawTable& table, const DrawWeights& weights, const Eigen::VectorXd& of_draws,
    const GaussianMixture& mixture) {
    std::vector<std::vector<Proposal::Regression>> regressions(table.own.size());
    std::vector<RowMatrix> features;
    for (const auto& part : mixture.parts) {
        RowMatrix rows(table.draws(), Proposal::features(part.mean).size());
        for (Eigen::Index k = 0; k < table.draws(); ++k)
            rows.row(k) = Proposal::features(table.shared.row(k).transpose() - part.mean)
                              .transpose();
        features.push_back(std::move(rows));
    }
    for (std::size_t lot = 0; lot < table.own.size(); ++lot) {
        const OwnMoments moments = own_moments(table, weights, of_draws, lot);
        for (std::size_t c = 0; c < features.size(); ++c)
            regressions[lot].push_back(
                regress(features[c], moments,
                        of_draws.cwiseProduct(
                            mixture.responsibilities.col(static_cast<Eigen::Index>(c)))));
    }
    return regressions;
}

}  // namespace

Proposal fit_proposal(const DrawTable& table, const DrawWeights& weights,
                      const DrawNumbers& numbers) {
    const double largest = weights.log_weights().maxCoeff();
    Eigen::VectorXd w = (weights.log_weights().array() - largest).exp();
    w /= w.sum();
    const double per_part = 6.0 * static_cast<double>(table.shared.cols() + 1);
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
    const bool nested = !table.own.empty() && table.own.front().cols() > 0;
    std::vector<std::vector<Proposal::Regression>> regressions;
    if (nested) regressions = regress_lots(table, weights, w, mixture);
    return {Mixture(prior_share, part_weights, std::move(parts)), std::move(regressions),
            prior_share};
}

}  // namespace taylorcal::calibrate
