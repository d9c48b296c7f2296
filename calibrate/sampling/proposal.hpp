#pragma once

#include "calibrate/sampling/heavy_tail.hpp"
#include "calibrate/sampling/parameter_space.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Where draws come from: the shared parameters from one mixture; then, given them, each
/// lot's own parameters from bells whose centres follow the shared ones.
class Proposal {
  public:
    /// A lot's own parameters near one part of the shared mixture: centred at
    /// coefficients^T features(shared - mean of the part).
    struct Regression {
        Eigen::MatrixXd coefficients;
        HeavyTail bell;  ///< centred at zero
        template <class Numbers>
        void visit(Numbers& numbers) {
            numbers(coefficients, bell);
        }
    };
    /// 1, the differences, and their squares and products: ridges are curved.
    static Eigen::VectorXd features(const Eigen::VectorXd& difference);

    /// The prior.
    explicit Proposal(const ParameterSpace& space);
    /// `regressions[lot][part]`, parts as in `shared`.
    Proposal(Mixture shared, std::vector<std::vector<Regression>> regressions,
             double prior_share);

    const Mixture& shared() const { return shared_; }
    /// The distribution of a lot's own parameters given the shared ones.
    Mixture own(std::size_t lot, const Eigen::VectorXd& shared) const;
    bool is_prior() const { return shared_.is_prior(); }
    template <class Numbers>
    void visit(Numbers& numbers) {
        numbers(shared_, own_dimension_, regressions_, prior_share_);
    }

  private:
    Mixture shared_;
    Eigen::Index own_dimension_;
    std::vector<std::vector<Regression>> regressions_;
    double prior_share_ = 1;
};

}  // namespace taylorcal::calibrate
