#include "calibrate/diagnosis/tail_probability.hpp"

#include <cmath>
#include <limits>

namespace taylorcal::calibrate {
namespace {

constexpr int most_terms = 10000;
constexpr double precise = 1e-15;

/// x^a exp(-x) / Gamma(a).
double gamma_prefactor(double a, double x) {
    return std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Lower regularised incomplete gamma function by its series, for x < a + 1.
double lower_gamma_series(double a, double x) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < most_terms && term > precise * sum; ++n)
        sum += term *= x / (a + n);
    return sum * gamma_prefactor(a, x);
}

/// Upper regularised incomplete gamma function by Lentz's continued fraction.
double upper_gamma_fraction(double a, double x) {
    constexpr double tiny = std::numeric_limits<double>::min();
    double b = x + 1 - a, c = 1 / tiny, d = 1 / b, value = d;
    for (int n = 1; n < most_terms; ++n) {
        const double step = -n * (n - a);
        b += 2;
        d = step * d + b;
        c = b + step / c;
        d = 1 / (d == 0 ? tiny : d);
        value *= d * c;
        if (std::abs(d * c - 1) < precise) break;
    }
    return value * gamma_prefactor(a, x);
}

}  // namespace

double normal_tail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

double normal_quantile_of_tail(double p) {
    double low = -40, high = 40;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (normal_tail(middle) > p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double chi2_tail(double x, double degrees) {
    if (!(x > 0) || !(degrees > 0)) return 1;
    const double a = 0.5 * degrees, y = 0.5 * x;
    return y < a + 1 ? 1 - lower_gamma_series(a, y) : upper_gamma_fraction(a, y);
}

}  // namespace taylorcal::calibrate
