#include "calibrate/diagnosis/tail_probability.hpp"

#include <cmath>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace taylorcal::calibrate {

double normal_tail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

double normal_quantile_of_tail(double p) {
    return std::sqrt(2.0) * boost::math::erfc_inv(2 * p);
}

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
