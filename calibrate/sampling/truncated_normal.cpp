#include "calibrate/sampling/truncated_normal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/special_functions/erf.hpp>

namespace taylorcal::calibrate {

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normal_quantile(double p) {
    if (p > 0.5) return -normal_quantile(1 - p);
    if (!(p > 0)) return -std::numeric_limits<double>::infinity();
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p);
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
