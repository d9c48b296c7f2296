#include "calibrate/diagnosis/extra_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {

double gain_of_extra_error(const Eigen::MatrixXd& columns,
                           const Eigen::VectorXd& residual,
                           std::span<const double> scales) {
    const Eigen::MatrixXd information = columns.transpose() * columns;
    const Eigen::VectorXd pull = columns.transpose() * residual;
    std::vector<double> gains;
    for (const double scale : scales) {
        const double variance = scale * scale;
        Eigen::MatrixXd grown = variance * information;
        grown.diagonal().array() += 1;
        const Eigen::LLT<Eigen::MatrixXd> cholesky(grown);
        gains.push_back(0.5 * variance * pull.dot(cholesky.solve(pull)) -
                        cholesky.matrixLLT().diagonal().array().log().sum());
    }
    const double highest = *std::max_element(gains.begin(), gains.end());
    double sum = 0;
    for (const double gain : gains) sum += std::exp(gain - highest);
    return highest + std::log(sum / static_cast<double>(gains.size()));
}

}  // namespace taylorcal::calibrate
