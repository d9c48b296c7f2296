#include "calibrate/comparison/influence.hpp"

#include "calibrate/likelihood/common_error.hpp"

#include <cmath>
#include <map>

#include <Eigen/LU>

namespace taylorcal::calibrate {
namespace {

/// Fitted shots whose errors are in common, with their covariance [mm^2] without the
/// spread.
struct Block {
    std::vector<const ShotComparison*> shots;
    Eigen::MatrixXd fixed_covariance;
};

/// What a shot adds to the others at each draw.
struct Conditional {
    RowMatrix residuals;          ///< y_s - E(y_s | the others) [draws x sizes, mm]
    Eigen::VectorXd log_density;  ///< ln p(y_s | the others), less ln(2 pi) n/2
    Eigen::MatrixXd covariance;   ///< of y_s, given the others, at the best spread [mm^2]
};

std::vector<Block> blocks_of(const ComparisonInputs& inputs,
                             const std::vector<ShotComparison>& shots) {
    std::vector<const ShotComparison*> fitted;
    for (const ShotComparison& shot : shots)
        if (shot.datum->shot.use == Use::calibrate) fitted.push_back(&shot);
    std::vector<Block> blocks;
    if (inputs.settings.network_errors == NetworkErrors::independent) {
        for (const ShotComparison* shot : fitted)
            blocks.push_back({{shot}, shot->fixed_covariance});
        return blocks;
    }
    for (std::size_t lot = 0; lot < inputs.set.lots.size(); ++lot) {
        Block block;
        std::vector<const Datum*> data;
        for (const ShotComparison* shot : fitted)
            if (shot->datum->lot == lot) {
                block.shots.push_back(shot);
                data.push_back(shot->datum);
            }
        if (data.empty()) continue;
        const RowMatrix point =
            inputs.space.lot_parameters(inputs.posterior.reference.transpose(), lot);
        block.fixed_covariance = lot_covariance(inputs.settings, inputs.predictor, data,
                                                point.row(0).transpose());
        blocks.push_back(std::move(block));
    }
    return blocks;
}

/// With Lambda = C^-1 of the block and r its residuals, a shot given the others has the
/// covariance Lambda_ss^-1 and the residual Lambda_ss^-1 (Lambda r)_s (Rue and Held 2005,
/// Gaussian Markov Random Fields, theorem 2.5).
std::vector<Conditional> condition(const ComparisonInputs& inputs, const Block& block) {
    const Eigen::Index draws = inputs.posterior.units.rows();
    const Eigen::Index n = block.fixed_covariance.rows();
    RowMatrix residuals(draws, n);
    Eigen::VectorXd scale(n);
    std::vector<Conditional> all;
    Eigen::Index at = 0;
    for (const ShotComparison* shot : block.shots) {
        const Eigen::Index own = shot->residual.size();
        residuals.middleCols(at, own) =
            shot->datum->measured_mm.transpose().replicate(draws, 1) - shot->draws;
        scale.segment(at, own) = shot->datum->scale_mm;
        all.push_back({RowMatrix(draws, own), Eigen::VectorXd(draws), {}});
        at += own;
    }
    std::vector<std::vector<Eigen::Index>> of_level(inputs.levels.values.size());
    for (Eigen::Index k = 0; k < draws; ++k)
        of_level[inputs.posterior.levels[static_cast<std::size_t>(k)]].push_back(k);
    const std::size_t best = inputs.posterior.maxima_levels.front();
    for (std::size_t g = 0; g < of_level.size(); ++g) {
        if (of_level[g].empty() && g != best) continue;
        Eigen::MatrixXd covariance = block.fixed_covariance;
        covariance.diagonal() += std::pow(inputs.levels.values[g], 2) * scale.cwiseAbs2();
        const Eigen::MatrixXd precision = covariance.inverse();
        const RowMatrix weighted = residuals(of_level[g], Eigen::all) * precision;
        at = 0;
        for (Conditional& shot : all) {
            const Eigen::Index own = shot.residuals.cols();
            const Eigen::MatrixXd conditional =
                precision.block(at, at, own, own).inverse();
            const RowMatrix found = weighted.middleCols(at, own) * conditional;
            shot.residuals(of_level[g], Eigen::all) = found;
            shot.log_density(of_level[g]) =
                (-0.5 * found.cwiseProduct(weighted.middleCols(at, own))
                            .rowwise()
                            .sum()
                            .array() -
                 0.5 * std::log(conditional.determinant()))
                    .matrix();
            if (g == best) shot.covariance = conditional;
            at += own;
        }
    }
    return all;
}

Influence influence_of(const ComparisonInputs& inputs, const ShotComparison& shot,
                       const Conditional& given_others) {
    const Eigen::VectorXd logs = -given_others.log_density;
    Eigen::VectorXd weights = (logs.array() - logs.maxCoeff()).exp();
    weights /= weights.sum();
    Influence influence;
    influence.id = shot.datum->shot.id;
    influence.n = shot.datum->columns.size();
    influence.effective_draws = 1 / weights.squaredNorm();
    const RowMatrix& units = inputs.posterior.units;
    const std::vector<std::string> names = inputs.space.names();
    for (Eigen::Index j = 0; j < units.cols(); ++j) {
        const double mean = units.col(j).mean();
        const double sd = std::sqrt((units.col(j).array() - mean).square().mean());
        const double shift = std::abs(units.col(j).dot(weights) - mean) / sd;
        if (!(shift > influence.largest_shift_sd)) continue;
        influence.largest_shift_sd = shift;
        influence.parameter = names[static_cast<std::size_t>(j)];
    }
    const Eigen::RowVectorXd mean = weights.transpose() * given_others.residuals;
    const RowMatrix centred = given_others.residuals.rowwise() - mean;
    const Eigen::MatrixXd covariance =
        given_others.covariance +
        Eigen::MatrixXd(centred.transpose() * weights.asDiagonal() * centred);
    influence.chi2_left_out = mean * covariance.inverse() * mean.transpose();
    return influence;
}

}  // namespace

std::vector<Influence> leave_one_out(const ComparisonInputs& inputs,
                                     const std::vector<ShotComparison>& shots) {
    std::map<const ShotComparison*, Influence> in_table_order;
    for (const Block& block : blocks_of(inputs, shots)) {
        const std::vector<Conditional> given_others = condition(inputs, block);
        for (std::size_t s = 0; s < block.shots.size(); ++s)
            in_table_order[block.shots[s]] =
                influence_of(inputs, *block.shots[s], given_others[s]);
    }
    std::vector<Influence> all;
    all.reserve(in_table_order.size());
    for (const auto& [shot, influence] : in_table_order) all.push_back(influence);
    return all;
}

}  // namespace taylorcal::calibrate
