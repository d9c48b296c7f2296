#include "calibrate/diagnosis/smooth_fit.hpp"

#include <array>
#include <limits>

#include <Eigen/LU>

namespace taylorcal::calibrate {
namespace {

constexpr std::array ridges{0.01, 0.1, 1.0, 10.0};
/// A richer polynomial must lower the error by this factor to be preferred.
constexpr double worth_a_term = 0.95;

struct Trial {
    Eigen::MatrixXd coefficients, spread;
    Eigen::MatrixXd left_out;  // errors of leaving one out
};

/// Least squares with a ridge on all terms but the constant.
Trial try_terms(const Eigen::MatrixXd& terms, const Eigen::MatrixXd& targets,
                double ridge) {
    Eigen::MatrixXd normal = terms.transpose() * terms;
    for (Eigen::Index j = 1; j < normal.cols(); ++j) normal(j, j) += ridge;
    Trial trial;
    trial.spread = normal.inverse();
    trial.coefficients = trial.spread * terms.transpose() * targets;
    const Eigen::MatrixXd errors = targets - terms * trial.coefficients;
    const Eigen::VectorXd free =
        (1 - ((terms * trial.spread).cwiseProduct(terms)).rowwise().sum().array())
            .max(1e-3);
    trial.left_out = free.cwiseInverse().asDiagonal() * errors;
    return trial;
}

std::vector<SmoothTerms> possible_terms(Eigen::Index inputs, bool has_amplitudes) {
    std::vector<SmoothTerms> all;
    for (const bool amplitude : {false, true}) {
        if (amplitude && !has_amplitudes) continue;
        for (const bool others : {false, true}) {
            if (others && inputs < 2) continue;
            for (const int order : {0, 1, 2}) all.push_back({order, others, amplitude});
        }
    }
    return all;
}

/// Sizes vary together less surely than few points say: half of each covariance between
/// outputs is kept at four points, nearly all at many.
Eigen::MatrixXd shrunk_covariance(const Eigen::MatrixXd& errors) {
    const auto n = static_cast<double>(errors.rows());
    Eigen::MatrixXd covariance = errors.transpose() * errors / n;
    const Eigen::VectorXd diagonal = covariance.diagonal();
    covariance *= n / (n + fewest_points);
    covariance.diagonal() = diagonal.cwiseMax(1e-16);
    return covariance;
}

}  // namespace

InputScaling::InputScaling(const Eigen::MatrixXd& points) {
    const Eigen::VectorXd low = points.colwise().minCoeff(),
                          high = points.colwise().maxCoeff();
    middle_ = 0.5 * (low + high);
    half_ = 0.5 * (high - low);
    for (Eigen::Index j = 0; j < half_.size(); ++j) {
        const bool varies = half_(j) > 1e-9 * std::abs(middle_(j));
        if (!varies) half_(j) = 1;
        if (varies || j == 0) kept_.push_back(j);
    }
}

Eigen::VectorXd InputScaling::operator()(const Eigen::VectorXd& point) const {
    const Eigen::VectorXd scaled = (point - middle_).cwiseQuotient(half_);
    return scaled(kept_).cwiseMax(-extrapolated).cwiseMin(extrapolated);
}

Eigen::VectorXd SmoothTerms::operator()(const Eigen::VectorXd& scaled,
                                        double amplitude) const {
    const Eigen::Index others = has_others ? scaled.size() - 1 : 0;
    Eigen::VectorXd terms(1 + velocity_order + others + (has_amplitude ? 2 : 0));
    Eigen::Index at = 0;
    double power = 1;
    for (int order = 0; order <= velocity_order; ++order, power *= scaled(0))
        terms(at++) = power;
    terms.segment(at, others) = scaled.tail(others);
    if (has_amplitude) terms.tail(2) << amplitude, amplitude * scaled(0);
    return terms;
}

SmoothFit fit_smoothly(const Eigen::MatrixXd& scaled, const Eigen::VectorXd& amplitudes,
                       const Eigen::MatrixXd& targets) {
    const Eigen::Index n = scaled.rows();
    const bool has_amplitudes =
        amplitudes.size() > 0 && amplitudes.maxCoeff() - amplitudes.minCoeff() >
                                     1e-6 * amplitudes.cwiseAbs().maxCoeff();
    // Outputs count alike, each by its spread about its mean.
    const Eigen::RowVectorXd weight =
        ((targets.rowwise() - targets.colwise().mean()).colwise().squaredNorm().array() /
             static_cast<double>(n) +
         1e-16)
            .inverse();
    SmoothFit best;
    best.chosen_error = std::numeric_limits<double>::infinity();
    for (const SmoothTerms& terms : possible_terms(scaled.cols(), has_amplitudes)) {
        const auto terms_at = [&](Eigen::Index i) {
            return terms(scaled.row(i).transpose(), has_amplitudes ? amplitudes(i) : 0);
        };
        Eigen::MatrixXd values(n, terms_at(0).size());
        for (Eigen::Index i = 0; i < n; ++i) values.row(i) = terms_at(i).transpose();
        for (const double ridge : ridges) {
            const Trial trial = try_terms(values, targets, ridge);
            const double error =
                (trial.left_out.colwise().squaredNorm().cwiseProduct(weight)).mean() /
                static_cast<double>(n);
            if (error >= worth_a_term * best.chosen_error) continue;
            best = {terms,
                    trial.coefficients,
                    trial.spread,
                    shrunk_covariance(trial.left_out),
                    static_cast<double>(n - values.cols()),
                    error};
        }
    }
    return best;
}

}  // namespace taylorcal::calibrate
