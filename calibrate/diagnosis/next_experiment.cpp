#include "calibrate/diagnosis/next_experiment.hpp"

#include "calibrate/diagnosis/whitening.hpp"

namespace taylorcal::calibrate {

double separation(const std::vector<Prediction>& explanations,
                  const Eigen::MatrixXd& covariance) {
    const Whitening whiten(covariance);
    double total = 0, sum = 0;
    for (const Prediction& one : explanations) total += one.weight;
    for (std::size_t k = 0; k < explanations.size(); ++k)
        for (std::size_t l = k + 1; l < explanations.size(); ++l)
            sum += explanations[k].weight * explanations[l].weight *
                   whiten(explanations[k].mean - explanations[l].mean).squaredNorm();
    return sum / (total * total);
}

}  // namespace taylorcal::calibrate
