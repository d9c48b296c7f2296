#include "calibrate/diagnosis/unexplained.hpp"

#include "calibrate/diagnosis/tail_probability.hpp"
#include "calibrate/measurements/velocity_thirds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace taylorcal::calibrate {
namespace {

constexpr std::size_t fewest_shots = 6;

Eigen::VectorXd ranks(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return values[a] < values[b]; });
    Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
        for (std::size_t i = first; i < last; ++i)
            result(static_cast<Eigen::Index>(order[i])) =
                0.5 * static_cast<double>(first + last - 1);
        first = last;
    }
    return result;
}

using Correlation = Unexplained::Correlation;

/// The size whose residuals follow the descriptor most closely.
Correlation strongest(const DiagnosisProblem& problem, const Eigen::VectorXd& residual,
                      std::size_t descriptor) {
    std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> by_size;
    for (std::size_t i = 0; i < problem.data.size(); ++i) {
        const double value =
            problem.descriptor_values(static_cast<Eigen::Index>(problem.data[i].shot),
                                      static_cast<Eigen::Index>(descriptor));
        if (!std::isfinite(value)) continue;
        auto& [x, y] = by_size[problem.data[i].size];
        x.push_back(value);
        y.push_back(residual(static_cast<Eigen::Index>(i)));
    }
    Correlation best{problem.descriptors[descriptor], "", 0, 1};
    std::size_t sizes = 0;
    for (const auto& [size, pairs] : by_size) {
        if (pairs.first.size() < fewest_shots) continue;
        ++sizes;
        const double found = rank_correlation(pairs.first, pairs.second);
        const double z =
            std::abs(found) * std::sqrt(static_cast<double>(pairs.first.size() - 1));
        const double p = 2 * normal_tail(z);
        if (p < best.p) best = {best.descriptor, size, found, p};
    }
    best.p = std::min(1.0, best.p * static_cast<double>(sizes));
    return best;
}

}  // namespace

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
    Eigen::VectorXd a = ranks(x), b = ranks(y);
    a.array() -= a.mean();
    b.array() -= b.mean();
    const double norm = a.norm() * b.norm();
    return norm > 0 ? a.dot(b) / norm : 0;
}

Unexplained describe_unexplained(const DiagnosisProblem& problem,
                                 const Eigen::VectorXd& residual) {
    const ThirdsOfVelocity thirds(problem.shots, &ShotLabel::velocity_m_s);
    std::map<std::tuple<std::string, std::string, std::size_t>, Unexplained::Cell> cells;
    for (std::size_t i = 0; i < problem.data.size(); ++i) {
        const ShotLabel& shot = problem.shots[problem.data[i].shot];
        Unexplained::Cell& cell =
            cells[{shot.shape, problem.data[i].size, thirds.index(shot.velocity_m_s)}];
        cell.shape = shot.shape;
        cell.size = problem.data[i].size;
        cell.velocity_third = thirds.word(shot.velocity_m_s);
        cell.mean_whitened += residual(static_cast<Eigen::Index>(i));
        ++cell.n;
    }
    Unexplained found;
    for (auto& [key, cell] : cells) {
        cell.mean_whitened /= static_cast<double>(cell.n);
        found.pattern.push_back(cell);
    }
    for (std::size_t d = 0; d < problem.descriptors.size(); ++d) {
        Correlation correlation = strongest(problem, residual, d);
        if (!correlation.size.empty()) found.correlations.push_back(correlation);
    }
    std::stable_sort(found.correlations.begin(), found.correlations.end(),
                     [](const auto& a, const auto& b) { return a.p < b.p; });
    return found;
}

}  // namespace taylorcal::calibrate
