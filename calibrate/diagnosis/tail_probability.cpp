#include "calibrate/diagnosis/tail_probability.hpp"

#include "calibrate/sampling/truncated_normal.hpp"

#include <cmath>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace taylorcal::calibrate {

double normal_tail(double z) { return normal_cdf(-z); }

double normal_quantile_of_tail(double p) { return -normal_quantile(p); }

double chi2_tail(double x, double degrees) {
    if (!(x > 0) || !(degrees > 0)) return 1;
    return boost::math::gamma_q(0.5 * degrees, 0.5 * x);
}

double fisher_tail(double x, double degrees, double freedom) {
    if (!std::isfinite(freedom)) return chi2_tail(degrees * x, degrees);
    if (!(x > 0) || !(degrees > 0)) return 1;
    return boost::math::ibeta(0.5 * freedom, 0.5 * degrees,
                              freedom / (freedom + degrees * x));
}

}  // namespace taylorcal::calibrate
