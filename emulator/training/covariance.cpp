#include "emulator/training/covariance.hpp"

#include <cmath>
#include <set>

#include <Eigen/Eigenvalues>

namespace taylorcal::emulator {

namespace {

/// Sums of products of errors, and how many, by pair of outputs.
struct PairSums {
    explicit PairSums(Eigen::Index outputs)
        : products(Eigen::MatrixXd::Zero(outputs, outputs)), counts(products) {}

    void add(const Eigen::RowVectorXd& errors) {
        const Eigen::RowVectorXd present =
            errors.array().isFinite().cast<double>().matrix();
        const Eigen::RowVectorXd filled =
            (present.array() > 0).select(errors.array(), 0).matrix();
        products += filled.transpose() * filled;
        counts += present.transpose() * present;
    }

    Eigen::MatrixXd products;
    Eigen::MatrixXd counts;
};

/// Outputs were counted in different rows, which can leave a negative eigenvalue.
Eigen::MatrixXd without_negative_variance(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    const double smallest = 1e-6 * solver.eigenvalues().maxCoeff();
    const Eigen::VectorXd kept = solver.eigenvalues().cwiseMax(smallest);
    return solver.eigenvectors() * kept.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

std::vector<std::pair<std::string, Covariance>> covariances(
    const RowMatrix& errors, const std::vector<std::string>& error_categories,
    const RowMatrix& known, const std::vector<std::string>& known_categories,
    const std::vector<std::string>& output_names) {
    constexpr double weight_of_all = 5;
    const Eigen::Index outputs = errors.cols();
    PairSums all(outputs);
    for (const auto& row : errors.rowwise()) all.add(row);
    const Eigen::MatrixXd pooled =
        (all.products.array() / all.counts.array().max(1)).matrix();

    std::vector<std::pair<std::string, Covariance>> result;
    for (const std::string& value :
         std::set<std::string>(known_categories.begin(), known_categories.end())) {
        PairSums own(outputs);
        for (Eigen::Index row = 0; row < errors.rows(); ++row) {
            if (error_categories[static_cast<std::size_t>(row)] == value) {
                own.add(errors.row(row));
            }
        }
        const Eigen::MatrixXd blended = ((own.products + weight_of_all * pooled).array() /
                                         (own.counts.array() + weight_of_all))
                                            .matrix();
        std::vector<Eigen::Index> present;
        Covariance covariance;
        for (Eigen::Index k = 0; k < outputs; ++k) {
            bool found = false;
            for (Eigen::Index row = 0; row < known.rows() && !found; ++row) {
                found = known_categories[static_cast<std::size_t>(row)] == value &&
                        std::isfinite(known(row, k));
            }
            if (!found) continue;
            present.push_back(k);
            covariance.outputs.push_back(output_names[static_cast<std::size_t>(k)]);
        }
        covariance.matrix = without_negative_variance(blended(present, present));
        result.emplace_back(value, std::move(covariance));
    }
    return result;
}

}  // namespace taylorcal::emulator
