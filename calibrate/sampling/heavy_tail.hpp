#pragma once

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Quantile of Student's t with four degrees of freedom, which has a closed form
/// (Shaw 2006, J. Comput. Finance 9(4)); p in (0, 1).
double t4_quantile(double p);

/// ln of its density (3/8) (1 + z^2/4)^(-5/2).
double t4_log_density(double z);

/// A bell with heavy tails: mean + root z, z independent t4. Tails heavier than the
/// likelihood's keep importance weights bounded.
class HeavyTail {
  public:
    /// Of no dimension, to be read into.
    HeavyTail() = default;
    /// `root`: lower triangle, for instance the Cholesky factor of a covariance.
    HeavyTail(Eigen::VectorXd mean, Eigen::MatrixXd root);
    Eigen::VectorXd draw(const Eigen::VectorXd& uniforms) const;
    double log_density(const Eigen::VectorXd& point) const;
    HeavyTail moved_to(const Eigen::VectorXd& mean) const;
    const Eigen::VectorXd& mean() const { return mean_; }
    template <class Numbers>
    void visit(Numbers& numbers) {
        numbers(mean_, root_, log_det_);
    }

  private:
    Eigen::VectorXd mean_;
    Eigen::MatrixXd root_;
    double log_det_ = 0;
};

/// A distribution over the unit cube to draw from: a share of the uniform prior, which
/// bounds every weight, and a mixture of heavy tails. Draws may leave the cube; there the
/// prior is zero, so they weigh nothing and the estimates stay unbiased.
class Mixture {
  public:
    /// The uniform prior alone.
    explicit Mixture(Eigen::Index dimension) : dimension_(dimension) {}
    Mixture(double prior_share, std::vector<double> weights,
            std::vector<HeavyTail> parts);

    /// One uniform a dimension; the first also picks the part, so that stratified
    /// uniforms give a stratified draw.
    Eigen::VectorXd draw(const Eigen::VectorXd& uniforms) const;
    double log_density(const Eigen::VectorXd& point) const;
    /// Shares of the parts (without the prior) at a point.
    std::vector<double> responsibilities(const Eigen::VectorXd& point) const;
    bool is_prior() const { return parts_.empty(); }
    const std::vector<HeavyTail>& parts() const { return parts_; }
    template <class Numbers>
    void visit(Numbers& numbers) {
        numbers(dimension_, prior_share_, weights_, parts_);
    }

  private:
    Eigen::Index dimension_;
    double prior_share_ = 1;
    std::vector<double> weights_;  // of the parts; sum to 1 - prior_share_
    std::vector<HeavyTail> parts_;
};

/// Whether a point lies in the unit cube, where the prior is one.
bool in_unit_cube(const Eigen::VectorXd& point);

}  // namespace taylorcal::calibrate
