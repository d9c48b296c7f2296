#include "calibrate/comparison/misfit.hpp"

#include "calibrate/likelihood/errors_of_shot.hpp"

#include <cmath>

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {

Misfit misfit(const std::vector<ShotComparison>& shots, Use use, double best_spread) {
    Misfit total;
    for (const ShotComparison& shot : shots) {
        if (shot.datum->shot.use != use) continue;
        const Eigen::LLT<Eigen::MatrixXd> cholesky(
            with_spread(shot.fixed_covariance, *shot.datum, best_spread));
        total.chi2_with_spread += cholesky.matrixL().solve(shot.residual).squaredNorm();
        total.chi2 += shot.whitened.squaredNorm();
        total.rms_relative +=
            shot.residual.cwiseQuotient(shot.datum->scale_mm).squaredNorm();
        total.n += shot.datum->columns.size();
    }
    if (total.n == 0) return total;
    const auto n = static_cast<double>(total.n);
    total.rms_relative = std::sqrt(total.rms_relative / n);
    total.whitened_rms = std::sqrt(total.chi2 / n);
    return total;
}

}  // namespace taylorcal::calibrate
