#include "calibrate/likelihood/errors_of_shot.hpp"

#include <algorithm>

namespace taylorcal::calibrate {
namespace {

Eigen::VectorXd sizes_at(const Predictor& predictor, const Datum& datum,
                         double velocity_m_s, const RowMatrix& parameters) {
    Shot shot = datum.shot;
    shot.velocity_m_s = velocity_m_s;
    const RowMatrix all = predictor.predict(shot, parameters);
    Eigen::VectorXd chosen(datum.measured_mm.size());
    for (std::size_t i = 0; i < datum.columns.size(); ++i)
        chosen(static_cast<Eigen::Index>(i)) = all(0, datum.columns[i]);
    return chosen;
}

}  // namespace

double velocity_sd(const Settings& settings, const Shot& shot) {
    return shot.velocity_sd_m_s.value_or(settings.velocity_sd_relative *
                                         shot.velocity_m_s);
}

Eigen::VectorXd velocity_slope(const Predictor& predictor, const Datum& datum,
                               const Eigen::VectorXd& parameters) {
    const double velocity = datum.shot.velocity_m_s;
    const double low = std::max(0.99 * velocity, predictor.lowest_velocity_m_s());
    const double high = std::min(1.01 * velocity, predictor.highest_velocity_m_s());
    if (!(high > low)) return Eigen::VectorXd::Zero(datum.measured_mm.size());
    const RowMatrix point = parameters.transpose();
    return (sizes_at(predictor, datum, high, point) -
            sizes_at(predictor, datum, low, point)) /
           (high - low);
}

Eigen::MatrixXd fixed_covariance(const Settings& settings, const Predictor& predictor,
                                 const Datum& datum, const Eigen::VectorXd& parameters) {
    const Eigen::Index n = datum.measured_mm.size();
    if (settings.likelihood == LikelihoodForm::paper) return Eigen::MatrixXd::Zero(n, n);
    const double sd_v = velocity_sd(settings, datum.shot);
    const Eigen::VectorXd slope = velocity_slope(predictor, datum, parameters);
    const Eigen::MatrixXd network = predictor.error_covariance(datum.shot, parameters);
    Eigen::MatrixXd covariance = slope * slope.transpose() * (sd_v * sd_v);
    covariance.diagonal() += datum.sd_mm.cwiseAbs2();
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            covariance(i, j) += network(datum.columns[static_cast<std::size_t>(i)],
                                        datum.columns[static_cast<std::size_t>(j)]);
    return covariance;
}

Eigen::MatrixXd with_spread(const Eigen::MatrixXd& fixed, const Datum& datum,
                            double spread) {
    Eigen::MatrixXd covariance = fixed;
    covariance.diagonal() += spread * spread * datum.scale_mm.cwiseAbs2();
    return covariance;
}

}  // namespace taylorcal::calibrate
