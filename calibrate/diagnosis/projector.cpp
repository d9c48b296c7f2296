#include "calibrate/diagnosis/projector.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace taylorcal::calibrate {

Projector::Projector(const Eigen::MatrixXd& slope) : basis_(slope.rows(), 0) {
    constexpr double no_influence = 0.5;  // standard errors over the unit range
    if (slope.cols() == 0 || slope.rows() == 0) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(slope.transpose() *
                                                                slope);
    const auto& squares = solver.eigenvalues();  // rising
    const Eigen::Index rank =
        std::min((squares.array() > no_influence * no_influence).count(), slope.rows());
    if (rank == 0) return;
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(slope *
                                                   solver.eigenvectors().rightCols(rank));
    basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(slope.rows(), rank);
}

}  // namespace taylorcal::calibrate
