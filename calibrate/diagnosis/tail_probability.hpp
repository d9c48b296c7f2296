#pragma once

namespace taylorcal::calibrate {

/// P(Z > z) of a standard normal, with its digits in the far tail.
double normal_tail(double z);
/// z with P(Z > z) = p, 0 < p < 1.
double normal_quantile_of_tail(double p);
/// P(X > x) of chi^2 with `degrees` degrees of freedom (not necessarily whole).
double chi2_tail(double x, double degrees);
/// P(X > x) of Fisher's F: chi^2/degrees over an estimated variance with `freedom`
/// degrees of freedom, which may be infinite.
double fisher_tail(double x, double degrees, double freedom);

}  // namespace taylorcal::calibrate
