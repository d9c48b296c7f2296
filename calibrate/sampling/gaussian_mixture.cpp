#include "calibrate/sampling/gaussian_mixture.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

constexpr int iterations = 40;

Eigen::Index pick_index(const Eigen::VectorXd& weights, double uniform) {
    double left = uniform * weights.sum();
    for (Eigen::Index i = 0; i < weights.size(); ++i)
        if ((left -= weights(i)) < 0) return i;
    return weights.size() - 1;
}

/// Nearest-start responsibilities, starts chosen as in k-means++.
RowMatrix first_responsibilities(const RowMatrix& points, const Eigen::VectorXd& weights,
                                 std::size_t parts, const std::vector<double>& picks) {
    RowMatrix owner = RowMatrix::Zero(points.rows(), static_cast<Eigen::Index>(parts));
    Eigen::VectorXd nearest =
        Eigen::VectorXd::Constant(points.rows(), std::numeric_limits<double>::infinity());
    std::vector<Eigen::Index> part_of(static_cast<std::size_t>(points.rows()), 0);
    Eigen::VectorXd chance = weights;
    for (std::size_t c = 0; c < parts; ++c) {
        const Eigen::RowVectorXd start = points.row(pick_index(chance, picks[c]));
        for (Eigen::Index i = 0; i < points.rows(); ++i) {
            const double distance = (points.row(i) - start).squaredNorm();
            if (distance >= nearest(i)) continue;
            nearest(i) = distance;
            part_of[static_cast<std::size_t>(i)] = static_cast<Eigen::Index>(c);
        }
        chance = weights.cwiseProduct(nearest);
        if (!(chance.sum() > 0)) break;
    }
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        owner(i, part_of[static_cast<std::size_t>(i)]) = 1;
    return owner;
}

/// Moments of the points that each part holds; empty parts vanish.
std::vector<GaussianMixture::Part> moments(const RowMatrix& points,
                                           const Eigen::VectorXd& weights,
                                           const RowMatrix& responsibilities) {
    std::vector<GaussianMixture::Part> parts;
    for (Eigen::Index c = 0; c < responsibilities.cols(); ++c) {
        const Eigen::VectorXd w = weights.cwiseProduct(responsibilities.col(c));
        GaussianMixture::Part part;
        part.weight = w.sum();
        if (part.weight < 1e-3) continue;
        part.mean = points.transpose() * w / part.weight;
        const RowMatrix centred = points.rowwise() - part.mean.transpose();
        part.covariance = centred.transpose() * w.asDiagonal() * centred / part.weight;
        parts.push_back(part);
    }
    return parts;
}

RowMatrix responsibilities_of(const std::vector<GaussianMixture::Part>& parts,
                              const RowMatrix& points) {
    RowMatrix logs(points.rows(), static_cast<Eigen::Index>(parts.size()));
    for (std::size_t c = 0; c < parts.size(); ++c) {
        const Eigen::MatrixXd root = safe_root(parts[c].covariance, floor_of_spread);
        const Eigen::MatrixXd centred =
            (points.rowwise() - parts[c].mean.transpose()).transpose();
        const Eigen::MatrixXd z = root.triangularView<Eigen::Lower>().solve(centred);
        logs.col(static_cast<Eigen::Index>(c)) =
            (std::log(parts[c].weight) - root.diagonal().array().log().sum() -
             0.5 * z.colwise().squaredNorm().transpose().array());
    }
    logs.colwise() -= logs.rowwise().maxCoeff().eval();
    RowMatrix shares = logs.array().exp();
    shares.array().colwise() /= shares.rowwise().sum().eval().array();
    return shares;
}

}  // namespace

Eigen::MatrixXd safe_root(const Eigen::MatrixXd& covariance, double floor) {
    Eigen::MatrixXd raised = covariance;
    raised.diagonal().array() += floor * floor;
    return Eigen::LLT<Eigen::MatrixXd>(raised).matrixL();
}

GaussianMixture fit_gaussian_mixture(const RowMatrix& points,
                                     const Eigen::VectorXd& weights, std::size_t parts,
                                     const std::vector<double>& picks) {
    GaussianMixture mixture;
    mixture.responsibilities = RowMatrix::Ones(points.rows(), 1);
    if (points.cols() > 0 && parts > 1)
        mixture.responsibilities = first_responsibilities(points, weights, parts, picks);
    mixture.parts = moments(points, weights, mixture.responsibilities);
    for (int i = 0; i < iterations && mixture.parts.size() > 1; ++i) {
        mixture.responsibilities = responsibilities_of(mixture.parts, points);
        mixture.parts = moments(points, weights, mixture.responsibilities);
    }
    mixture.responsibilities = points.cols() > 0
                                   ? responsibilities_of(mixture.parts, points)
                                   : RowMatrix::Ones(points.rows(), 1);
    return mixture;
}

}  // namespace taylorcal::calibrate
