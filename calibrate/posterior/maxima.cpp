#include "calibrate/posterior/maxima.hpp"

#include "calibrate/posterior/mean_shift.hpp"
#include "calibrate/posterior/refine.hpp"
#include "calibrate/posterior/thinned.hpp"
#include "calibrate/sampling/log_sum.hpp"

#include <algorithm>

namespace taylorcal::calibrate {
namespace {

constexpr Eigen::Index most_points = 1000;
constexpr double smallest_share = 0.01;  // of the largest
constexpr std::size_t few = 20;
constexpr Eigen::Index most_coordinates = 4;
constexpr double same_point = 0.01;  // of the priors' widths

/// ln posterior density over the unit cube for each row, the spread averaged out.
Eigen::VectorXd log_density(const LotLikelihood& likelihood, const RowMatrix& units) {
    const RowMatrix log_likelihood = likelihood.log_likelihood(units);
    const std::vector<double>& log_mass = likelihood.levels().log_mass;
    Eigen::VectorXd densities(units.rows());
    for (Eigen::Index i = 0; i < units.rows(); ++i) {
        LogSum sum;
        for (std::size_t g = 0; g < log_mass.size(); ++g)
            sum.add(log_mass[g] + log_likelihood(i, static_cast<Eigen::Index>(g)));
        densities(i) = sum.value();
    }
    return densities;
}

/// The draw of the highest density among the few nearest to a mode.
Eigen::Index best_near(const Eigen::RowVectorXd& mode, const RowMatrix& points,
                       const Eigen::RowVectorXd& width, std::vector<Eigen::Index> members,
                       const Eigen::VectorXd& densities) {
    const auto distance = [&](Eigen::Index i) {
        return ((points.row(i) - mode).array() / width.array()).matrix().squaredNorm();
    };
    std::stable_sort(members.begin(), members.end(), [&](Eigen::Index a, Eigen::Index b) {
        return distance(a) < distance(b);
    });
    members.resize(std::min(members.size(), few));
    return *std::max_element(
        members.begin(), members.end(),
        [&](Eigen::Index a, Eigen::Index b) { return densities(a) < densities(b); });
}

/// Adds to the list, or to the share of a maximum that is the same point.
void merge(std::vector<Maximum>& maxima, Maximum found) {
    for (Maximum& other : maxima)
        if ((other.unit - found.unit).lpNorm<Eigen::Infinity>() < same_point) {
            const double share = other.share + found.share;
            if (found.log_density > other.log_density) other = found;
            other.share = share;
            return;
        }
    maxima.push_back(std::move(found));
}

}  // namespace

std::vector<Maximum> find_maxima(const LotLikelihood& likelihood,
                                 const WeightedDraws& draws, double log_evidence) {
    const RowMatrix units = thinned(draws.units, most_points);
    const auto shared = static_cast<Eigen::Index>(likelihood.space().shared_count());
    // A smoothed density tells modes apart in a few dimensions only.
    const Eigen::Index coordinates = shared > 0 ? shared : units.cols();
    const RowMatrix points =
        units.leftCols(coordinates <= most_coordinates ? coordinates : 0);
    const Basins basins = find_basins(points);
    const Eigen::VectorXd densities = log_density(likelihood, units);
    const Eigen::RowVectorXd mean = units.colwise().mean();
    const Eigen::VectorXd spread =
        (units.rowwise() - mean).array().square().colwise().mean().sqrt().transpose();
    const Eigen::RowVectorXd width =
        spread.head(points.cols()).transpose().cwiseMax(1e-9);
    std::vector<std::vector<Eigen::Index>> members(
        static_cast<std::size_t>(basins.modes.rows()));
    for (std::size_t i = 0; i < basins.member.size(); ++i)
        members[basins.member[i]].push_back(static_cast<Eigen::Index>(i));
    std::size_t largest = 0;
    for (const auto& basin : members) largest = std::max(largest, basin.size());
    std::vector<Maximum> maxima;
    for (std::size_t mode = 0; mode < members.size(); ++mode) {
        const auto size = static_cast<double>(members[mode].size());
        if (size < smallest_share * static_cast<double>(largest)) continue;
        const Eigen::Index best =
            best_near(basins.modes.row(static_cast<Eigen::Index>(mode)), points, width,
                      members[mode], densities);
        const RefinedPoint refined =
            refine(likelihood, units.row(best).transpose(), 0.2 * spread);
        const double density = log_density(likelihood, refined.unit.transpose())(0);
        merge(maxima, {refined.unit, refined.level, density - log_evidence,
                       size / static_cast<double>(units.rows())});
    }
    std::stable_sort(
        maxima.begin(), maxima.end(),
        [](const Maximum& a, const Maximum& b) { return a.log_density > b.log_density; });
    return maxima;
}

}  // namespace taylorcal::calibrate
