#include "calibrate/diagnosis/contrasts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/LU>

namespace taylorcal::calibrate {
namespace {

constexpr double absorbed = 0.02;  // share of a direction that must survive projection
constexpr double percent = 0.01;
constexpr std::size_t enough_for_mean = 2;
constexpr std::size_t enough_for_slope = 4;

double velocity_of(const DiagnosisProblem& problem, std::size_t datum) {
    return problem.shots[problem.data[datum].shot].velocity_m_s;
}

using Groups = std::map<std::pair<std::string, std::string>, std::vector<std::size_t>>;

/// Numbers of each shape and size.
Groups groups_of(const DiagnosisProblem& problem) {
    Groups groups;
    for (std::size_t i = 0; i < problem.data.size(); ++i)
        groups[{problem.shots[problem.data[i].shot].shape, problem.data[i].size}]
            .push_back(i);
    return groups;
}

/// 1 % of each number times Legendre's polynomial of this order, velocities from -1 to 1;
/// zero when all velocities are equal and the order is not.
Eigen::VectorXd pattern_of(const DiagnosisProblem& problem,
                           const std::vector<std::size_t>& data, unsigned order) {
    double lowest = velocity_of(problem, data.front()), highest = lowest;
    for (const std::size_t i : data) {
        lowest = std::min(lowest, velocity_of(problem, i));
        highest = std::max(highest, velocity_of(problem, i));
    }
    const double half = 0.5 * (highest - lowest), middle = 0.5 * (highest + lowest);
    Eigen::VectorXd pattern = Eigen::VectorXd::Zero(problem.measured.size());
    if (order > 0 && !(half > 0)) return pattern;
    for (const std::size_t i : data) {
        const double place = half > 0 ? (velocity_of(problem, i) - middle) / half : 0;
        pattern(static_cast<Eigen::Index>(i)) =
            percent * problem.data[i].scale_mm * std::legendre(order, place);
    }
    return pattern;
}

}  // namespace

std::vector<Contrast> battery_contrasts(const DiagnosisProblem& problem) {
    std::vector<Contrast> contrasts;
    const auto add = [&](const auto& group, const char* what, unsigned order) {
        const auto& [key, data] = group;
        Contrast contrast;
        contrast.shape = key.first;
        contrast.size = key.second;
        contrast.what = what;
        contrast.direction = pattern_of(problem, data, order);
        if (contrast.direction.squaredNorm() > 0)
            contrasts.push_back(std::move(contrast));
    };
    for (const auto& group : groups_of(problem)) {
        if (group.second.size() >= enough_for_mean) add(group, "mean", 0);
        if (group.second.size() >= enough_for_slope) add(group, "slope", 1);
    }
    return contrasts;
}

Eigen::MatrixXd smooth_patterns(const DiagnosisProblem& problem) {
    constexpr unsigned highest_order = 2;
    std::vector<Eigen::VectorXd> patterns;
    for (const auto& [key, data] : groups_of(problem))
        for (unsigned order = 0; order <= highest_order && order < data.size(); ++order)
            patterns.push_back(pattern_of(problem, data, order));
    Eigen::MatrixXd columns(problem.measured.size(),
                            static_cast<Eigen::Index>(patterns.size()));
    for (std::size_t i = 0; i < patterns.size(); ++i)
        columns.col(static_cast<Eigen::Index>(i)) = patterns[i];
    return columns;
}

std::vector<Contrast> drift_contrasts(const DiagnosisProblem& problem,
                                      const Eigen::MatrixXd& slope) {
    constexpr double prior_precision = 12;  // of a coordinate uniform in [0, 1]
    std::map<std::string, std::vector<Eigen::Index>> rows;
    for (std::size_t i = 0; i < problem.data.size(); ++i)
        rows[problem.shots[problem.data[i].shot].shape].push_back(
            static_cast<Eigen::Index>(i));
    std::vector<Contrast> contrasts;
    if (rows.size() < 2) return contrasts;
    for (const auto& [shape, members] : rows) {
        const Eigen::MatrixXd own = slope(members, Eigen::all);
        Eigen::MatrixXd information = own.transpose() * own;
        information.diagonal().array() += prior_precision;
        const Eigen::MatrixXd weights = own * information.inverse();
        for (Eigen::Index j = 0; j < slope.cols(); ++j) {
            // A parameter of another lot, or one that this shape does not feel.
            if (own.col(j).squaredNorm() < prior_precision) continue;
            Contrast contrast;
            contrast.shape = shape;
            contrast.what = problem.parameters[static_cast<std::size_t>(j)];
            contrast.direction = Eigen::VectorXd::Zero(slope.rows());
            contrast.direction(members) = weights.col(j);
            contrasts.push_back(std::move(contrast));
        }
    }
    return contrasts;
}

double test_contrasts(std::vector<Contrast>& contrasts, const Projector& project,
                      const Eigen::VectorXd& residual, const NormalTable& table) {
    std::vector<Contrast> kept;
    for (Contrast& contrast : contrasts) {
        const Eigen::VectorXd projected = project(contrast.direction);
        const double norm = projected.norm();
        if (norm <= absorbed * contrast.direction.norm()) continue;
        contrast.z = projected.dot(residual) / norm;
        contrast.amount = contrast.z / norm;
        contrast.direction = projected;
        kept.push_back(std::move(contrast));
    }
    contrasts = std::move(kept);
    if (contrasts.empty()) return 1;
    Eigen::MatrixXd directions(residual.size(),
                               static_cast<Eigen::Index>(contrasts.size()));
    for (std::size_t i = 0; i < contrasts.size(); ++i)
        directions.col(static_cast<Eigen::Index>(i)) = contrasts[i].direction;
    const MaximumTest test(directions, std::vector<Side>(contrasts.size(), Side::both),
                           table);
    for (Contrast& contrast : contrasts)
        contrast.p = test.probability(std::abs(contrast.z));
    std::stable_sort(
        contrasts.begin(), contrasts.end(),
        [](const auto& a, const auto& b) { return std::abs(a.z) > std::abs(b.z); });
    return contrasts.front().p;
}

}  // namespace taylorcal::calibrate
