#pragma once

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

inline constexpr Eigen::Index fewest_points = 4;
/// Polynomials hold beyond the range of their points by a quarter.
inline constexpr double extrapolated = 1.25;

/// Inputs brought to about [-1, 1] by the range of the points they were fitted on. The
/// first input (velocity) is always kept; others only if they vary. Beyond the range by
/// more than a quarter they are held: a polynomial knows nothing there.
class InputScaling {
  public:
    InputScaling() = default;
    /// A point a row.
    explicit InputScaling(const Eigen::MatrixXd& points);
    Eigen::VectorXd operator()(const Eigen::VectorXd& point) const;

  private:
    std::vector<Eigen::Index> kept_;
    Eigen::VectorXd middle_, half_;
};

/// Which terms a polynomial has besides the constant.
struct SmoothTerms {
    int velocity_order = 0;
    bool has_others = false;     ///< linear in the other inputs
    bool has_amplitude = false;  ///< amplitude, and amplitude x velocity

    /// Values of the terms at a scaled point; amplitude counted in typical ones.
    Eigen::VectorXd operator()(const Eigen::VectorXd& scaled, double amplitude) const;
};

/// A ridge-regularised polynomial for several outputs at once; terms and ridge chosen by
/// the error of leaving one point out.
struct SmoothFit {
    SmoothTerms terms;
    Eigen::MatrixXd coefficients;  ///< [terms x outputs]
    /// Covariance of the coefficients of outputs a and b: noise(a, b) x this.
    Eigen::MatrixXd spread;
    /// Covariance of a new point about the polynomial: of the errors of leaving one out,
    /// since the terms were chosen among many by the very points.
    Eigen::MatrixXd noise;
    /// Points less terms: how well the noise is known.
    double freedom = 0;
    double chosen_error = 0;  ///< mean squared leave-one-out error over that of the data

    Eigen::VectorXd operator()(const Eigen::VectorXd& terms_at) const {
        return coefficients.transpose() * terms_at;
    }
};

/// `scaled`: a scaled point a row; `amplitudes`: empty, or one a row, then terms in the
/// amplitude are tried if it varies. At least `fewest_points`.
SmoothFit fit_smoothly(const Eigen::MatrixXd& scaled, const Eigen::VectorXd& amplitudes,
                       const Eigen::MatrixXd& targets);

}  // namespace taylorcal::calibrate
