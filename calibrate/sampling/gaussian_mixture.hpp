#pragma once

#include "common/hdf5_file.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// No Gaussian is narrower than this share of the prior's width.
inline constexpr double floor_of_spread = 1e-4;

/// Weighted points in the unit cube described by a few Gaussians.
struct GaussianMixture {
    struct Part {
        double weight = 1;
        Eigen::VectorXd mean;
        Eigen::MatrixXd covariance;
    };
    std::vector<Part> parts;
    RowMatrix responsibilities;  ///< of the parts (columns) for the points (rows)
};

/// Fits by expectation maximisation from starts spread over the points (each next start
/// drawn away from the ones before); parts that lose their points are dropped. Weights
/// sum to one. `picks`: uniform numbers, used in turn. A point of no dimensions yields
/// one part.
GaussianMixture fit_gaussian_mixture(const RowMatrix& points,
                                     const Eigen::VectorXd& weights, std::size_t parts,
                                     const std::vector<double>& picks);

/// Lower Cholesky factor of a covariance, after raising its diagonal by `floor`^2.
Eigen::MatrixXd safe_root(const Eigen::MatrixXd& covariance, double floor);

}  // namespace taylorcal::calibrate
