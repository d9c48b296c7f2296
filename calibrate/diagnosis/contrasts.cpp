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

Contrast mean_of(const DiagnosisProblem& problem, const std::vector<std::size_t>& data) {
    Contrast contrast;
    contrast.what = "mean";
    contrast.direction = Eigen::VectorXd::Zero(problem.measured.size());
    for (const std::size_t i : data)
        contrast.direction(static_cast<Eigen::Index>(i)) =
            percent * problem.data[i].scale_mm;
    return contrast;
}

/// The velocities' ends get -1 and 1; no direction when all velocities are equal.
Contrast slope_of(const DiagnosisProblem& problem, const std::vector<std::size_t>& data) {
    Contrast contrast = mean_of(problem, data);
    contrast.what = "slope";
    double lowest = velocity_of(problem, data.front()), highest = lowest;
    for (const std::size_t i : data) {
        lowest = std::min(lowest, velocity_of(problem, i));
        highest = std::max(highest, velocity_of(problem, i));
    }
    const double half = 0.5 * (highest - lowest), middle = 0.5 * (highest + lowest);
    for (const std::size_t i : data)
        contrast.direction(static_cast<Eigen::Index>(i)) *=
            half > 0 ? (velocity_of(problem, i) - middle) / half : 0;
    return contrast;
}

}  // namespace

std::vector<Contrast> battery_contrasts(const DiagnosisProblem& problem) {
    std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < problem.data.size(); ++i)
        groups[{problem.shots[problem.data[i].shot].shape, problem.data[i].size}]
            .push_back(i);
    std::vector<Contrast> contrasts;
    const auto add = [&](Contrast contrast, const auto& key) {
        contrast.shape = key.first;
        contrast.size = key.second;
        if (contrast.direction.squaredNorm() > 0)
            contrasts.push_back(std::move(contrast));
    };
    for (const auto& [key, data] : groups) {
        if (data.size() >= enough_for_mean) add(mean_of(problem, data), key);
        if (data.size() >= enough_for_slope) add(slope_of(problem, data), key);
    }
    return contrasts;
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
