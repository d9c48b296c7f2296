#include "calibrate/likelihood/common_error.hpp"

#include "calibrate/likelihood/errors_of_shot.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace taylorcal::calibrate {
namespace {

// Correlations of (solver - network) seen along the velocities of twenty metals of known
// parameters (tests/verification, study `twins`): 0.56, 0.35, 0.21, 0.12 at 12, 24, 35,
// 47 m/s of a range of 110 m/s, and 0.22 between shapes. The rest is grains. A network of
// twice the runs has 0.52, 0.29, 0.12, 0.04 and 0.13: somewhat too careful for that one.
constexpr double smooth_share = 0.9;
constexpr double reach = 0.21;  // of the ranges of what tells shots apart
constexpr double between_shapes = 0.25;

/// Rows of E^(1/2), of the sizes that the shot has; columns are all fitted sizes.
Eigen::MatrixXd root_of_network_error(const Predictor& predictor, const Datum& datum,
                                      const Eigen::VectorXd& parameters) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        predictor.error_covariance(datum.shot, parameters));
    const Eigen::VectorXd roots = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
    const Eigen::MatrixXd root =
        solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
    return root(datum.columns, Eigen::all);
}

}  // namespace

double common_share(const Predictor& predictor, const Shot& a, const Shot& b) {
    return smooth_share * std::exp(-predictor.apart(a, b) / reach) *
           (a.shape == b.shape ? 1 : between_shapes);
}

Eigen::MatrixXd lot_covariance(const Settings& settings, const Predictor& predictor,
                               const std::vector<const Datum*>& shots,
                               const Eigen::VectorXd& parameters) {
    std::vector<Eigen::MatrixXd> roots;
    std::vector<Eigen::Index> starts;
    Eigen::Index n = 0;
    for (const Datum* datum : shots) {
        roots.push_back(root_of_network_error(predictor, *datum, parameters));
        starts.push_back(n);
        n += datum->measured_mm.size();
    }
    Eigen::MatrixXd covariance(n, n);
    for (std::size_t i = 0; i < shots.size(); ++i) {
        const Eigen::Index rows = roots[i].rows();
        for (std::size_t j = 0; j < i; ++j) {
            const Eigen::MatrixXd block =
                common_share(predictor, shots[i]->shot, shots[j]->shot) * roots[i] *
                roots[j].transpose();
            covariance.block(starts[i], starts[j], rows, roots[j].rows()) = block;
            covariance.block(starts[j], starts[i], roots[j].rows(), rows) =
                block.transpose();
        }
        covariance.block(starts[i], starts[i], rows, rows) =
            fixed_covariance(settings, predictor, *shots[i], parameters);
    }
    return covariance;
}

}  // namespace taylorcal::calibrate
