#include "calibrate/sampling/truncated_normal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace taylorcal::calibrate {
namespace {

/// P. J. Acklam's rational approximations (2003) of the quantile for p <= 0.5, relative
/// error 1.2e-9.
double rough_lower_quantile(double p) {
    constexpr double from_tail = 0.02425;
    if (p < from_tail) {
        const double q = std::sqrt(-2 * std::log(p));
        return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q -
                   2.400758277161838e+00) *
                      q -
                  2.549732539343734e+00) *
                     q +
                 4.374664141464968e+00) *
                    q +
                2.938163982698783e+00) /
               ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q +
                  2.445134137142996e+00) *
                     q +
                 3.754408661907416e+00) *
                    q +
                1);
    }
    const double q = p - 0.5, r = q * q;
    return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r -
               2.759285104469687e+02) *
                  r +
              1.383577518672690e+02) *
                 r -
             3.066479806614716e+01) *
                r +
            2.506628277459239e+00) *
           q /
           (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r -
               1.556989798598866e+02) *
                  r +
              6.680131188771972e+01) *
                 r -
             1.328068155288572e+01) *
                r +
            1);
}

}  // namespace

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normal_quantile(double p) {
    if (p > 0.5) return -normal_quantile(1 - p);
    if (!(p > 0)) return -std::numeric_limits<double>::infinity();
    const double z = rough_lower_quantile(p);
    // One step of Halley's method gives all digits.
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
    const double step = (normal_cdf(z) - p) / density;
    return z - step / (1 + 0.5 * z * step);
}

TruncatedNormal::TruncatedNormal(double scale, double lower, double upper)
    : scale_(scale), lower_(lower), upper_(upper), mirrored_(lower > 0) {
    const double from = mirrored_ ? -upper : lower, to = mirrored_ ? -lower : upper;
    below_ = normal_cdf(from / scale);
    within_ = normal_cdf(to / scale) - below_;
}

double TruncatedNormal::quantile(double u) const {
    const double share = mirrored_ ? 1 - u : u;
    const double z = normal_quantile(below_ + share * within_);
    return std::clamp(scale_ * (mirrored_ ? -z : z), lower_, upper_);
}

double TruncatedNormal::cdf(double value) const {
    const double z = std::clamp(value, lower_, upper_) / scale_;
    const double share = (normal_cdf(mirrored_ ? -z : z) - below_) / within_;
    return mirrored_ ? 1 - share : share;
}

}  // namespace taylorcal::calibrate
