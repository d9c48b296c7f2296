#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Which sign of a statistic counts.
enum class Side { both, positive, negative };

/// Standard normal numbers shared by all tests of a diagnosis. The null of a maximum is
/// found by pushing them through the correlation's root: exact for the number of
/// statistics and for how they hang together.
class NormalTable {
  public:
    /// `columns`: the most statistics that a test may have.
    NormalTable(std::uint64_t seed, Eigen::Index columns, Eigen::Index draws = 20000);
    /// The first `count` columns [draws x count]; a number depends on (seed, draw,
    /// column) only.
    Eigen::Ref<const Eigen::MatrixXd> columns(Eigen::Index count) const;

  private:
    Eigen::MatrixXd numbers_;
};

/// The maximum over several correlated unit normal statistics.
class MaximumTest {
  public:
    /// `directions`: a whitened vector b a column; the statistics are b^T r / |b|.
    MaximumTest(const Eigen::MatrixXd& directions, std::vector<Side> sides,
                const NormalTable& table);

    /// The statistic as its side sees it: |z|, z or -z.
    double strength(std::size_t i, double z) const;
    /// Family-wise probability of a maximum at least as strong.
    double probability(double strength) const;
    /// The strength whose family-wise probability is `p`.
    double critical(double p) const;

  private:
    std::vector<Side> sides_;
    std::vector<double> maxima_;  // of the null, rising
};

}  // namespace taylorcal::calibrate
