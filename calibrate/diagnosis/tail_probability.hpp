#pragma once

namespace taylorcal::calibrate {

/// P(Z > z) of a standard normal, with its digits in the far tail.
double normal_tail(double z);
/// z with P(Z > z) = p, 0 < p < 1.
double normal_quantile_of_tail(double p);
/// P(X > x) of chi^2 with `degrees` degrees of freedom (not necessarily whole).
double chi2_tail(double x, double degrees);

}  // namespace taylorcal::calibrate
