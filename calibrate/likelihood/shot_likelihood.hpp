#pragma once

#include "calibrate/likelihood/spread_levels.hpp"
#include "calibrate/measurements/data_set.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Gaussian likelihood of one shot at every level of the relative spread, ln det C kept:
/// ln L = -(1/2) [ r^T C^-1 r + ln det C + n ln 2 pi ], r = measured - predicted.
///
/// In the paper's form (its Eq. 27: independent relative deviations of one common sigma)
/// C = sigma^2 diag(y^2), and sigma is marginalised over its grid with a scale-free
/// prior.
class ShotLikelihood {
  public:
    /// `fixed`: the covariance without the spread [mm^2]. NumericalError if C is
    /// singular.
    ShotLikelihood(const Datum& datum, const Eigen::MatrixXd& fixed,
                   const SpreadLevels& levels);

    /// Adds ln L of each level to `log_likelihood` (one number a level). `predicted`: all
    /// fitted sizes [mm].
    template <class Row>
    void add(const Row& predicted, double* log_likelihood) const {
        const Eigen::Index n = measured_.size();
        double residual[max_sizes];
        for (Eigen::Index i = 0; i < n; ++i)
            residual[i] = measured_(i) - predicted(columns_[static_cast<std::size_t>(i)]);
        const double* root = inverse_roots_.data();
        for (std::size_t g = 0; g < log_norms_.size(); ++g) {
            double chi2 = 0;
            for (Eigen::Index i = 0; i < n; ++i) {
                double whitened = 0;
                for (Eigen::Index j = 0; j <= i; ++j) whitened += *root++ * residual[j];
                chi2 += whitened * whitened;
            }
            log_likelihood[g] += log_norms_[g] - 0.5 * chi2;
        }
    }
    /// L^-1 (measured - predicted) at one level, with C = L L^T.
    Eigen::VectorXd whitened(const Eigen::VectorXd& predicted, std::size_t level) const;

    /// Number of sizes.
    std::size_t size() const { return columns_.size(); }
    const Eigen::VectorXd& measured() const { return measured_; }
    /// Which fitted sizes they are.
    const std::vector<Eigen::Index>& columns() const { return columns_; }
    /// L^-1 at one level, lower triangle.
    Eigen::MatrixXd inverse_root(std::size_t level) const;
    /// ln L of a perfect fit at one level: -(ln det C + n ln 2 pi)/2.
    double log_norm(std::size_t level) const { return log_norms_[level]; }

  private:
    static constexpr Eigen::Index max_sizes = 16;
    Eigen::VectorXd measured_;
    std::vector<Eigen::Index> columns_;
    std::vector<double> inverse_roots_;  // lower triangles of L^-1, row by row, by level
    std::vector<double> log_norms_;
};

}  // namespace taylorcal::calibrate
