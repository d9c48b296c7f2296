#include "calibrate/sampling/heavy_tail.hpp"

#include "calibrate/sampling/log_sum.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::calibrate {

double t4_quantile(double p) {
    const double root_a = 2 * std::sqrt(p * (1 - p));
    const double size =
        2 * std::sqrt(std::max(
                0.0, std::cos(std::acos(std::min(root_a, 1.0)) / 3) / root_a - 1));
    return p < 0.5 ? -size : size;
}

double t4_log_density(double z) {
    return std::log(0.375) - 2.5 * std::log1p(0.25 * z * z);
}

HeavyTail::HeavyTail(Eigen::VectorXd mean, Eigen::MatrixXd root)
    : mean_(std::move(mean)), root_(std::move(root)) {
    log_det_ = root_.diagonal().array().log().sum();
}

Eigen::VectorXd HeavyTail::draw(const Eigen::VectorXd& uniforms) const {
    return mean_ +
           root_.triangularView<Eigen::Lower>() * uniforms.unaryExpr(&t4_quantile);
}

double HeavyTail::log_density(const Eigen::VectorXd& point) const {
    const Eigen::VectorXd z = root_.triangularView<Eigen::Lower>().solve(point - mean_);
    return z.unaryExpr(&t4_log_density).sum() - log_det_;
}

HeavyTail HeavyTail::moved_to(const Eigen::VectorXd& mean) const {
    HeavyTail moved = *this;
    moved.mean_ = mean;
    return moved;
}

Mixture::Mixture(double prior_share, std::vector<double> weights,
                 std::vector<HeavyTail> parts)
    : dimension_(parts.front().mean().size()),
      prior_share_(prior_share),
      weights_(std::move(weights)),
      parts_(std::move(parts)) {
    double total = 0;
    for (const double weight : weights_) total += weight;
    for (double& weight : weights_) weight *= (1 - prior_share_) / total;
}

Eigen::VectorXd Mixture::draw(const Eigen::VectorXd& uniforms) const {
    if (is_prior() || dimension_ == 0) return uniforms;
    // The part of the first uniform that is left over after choosing is uniform again.
    Eigen::VectorXd rest = uniforms;
    double left = uniforms(0);
    if (left < prior_share_) {
        rest(0) = left / prior_share_;
        return rest;
    }
    left -= prior_share_;
    std::size_t part = 0;
    while (part + 1 < parts_.size() && left >= weights_[part]) left -= weights_[part++];
    rest(0) = std::clamp(left / weights_[part], 1e-15, 1 - 1e-15);
    return parts_[part].draw(rest);
}

double Mixture::log_density(const Eigen::VectorXd& point) const {
    if (is_prior() || dimension_ == 0) return 0;
    LogSum sum;
    if (in_unit_cube(point)) sum.add(std::log(prior_share_));
    for (std::size_t c = 0; c < parts_.size(); ++c)
        sum.add(std::log(weights_[c]) + parts_[c].log_density(point));
    return sum.value();
}

std::vector<double> Mixture::responsibilities(const Eigen::VectorXd& point) const {
    std::vector<double> shares;
    LogSum sum;
    for (std::size_t c = 0; c < parts_.size(); ++c) {
        shares.push_back(std::log(weights_[c]) + parts_[c].log_density(point));
        sum.add(shares.back());
    }
    for (double& share : shares) share = std::exp(share - sum.value());
    return shares;
}

bool in_unit_cube(const Eigen::VectorXd& point) {
    return (point.array() >= 0).all() && (point.array() <= 1).all();
}

}  // namespace taylorcal::calibrate
