#pragma once

namespace taylorcal::calibrate {

/// Distribution function of the standard normal.
double normal_cdf(double z);
/// Its inverse; -inf and +inf at 0 and 1.
double normal_quantile(double p);

/// A normal distribution around 0 cut off at lower and upper, with lower < upper.
class TruncatedNormal {
  public:
    TruncatedNormal(double scale, double lower, double upper);

    /// The value below which the share `u` in [0, 1] of the distribution lies.
    double quantile(double u) const;
    /// The share of the distribution below `value`.
    double cdf(double value) const;

  private:
    double scale_;
    double lower_, upper_;
    double below_;   // the whole normal's mass below lower
    double within_;  // and between the two
    bool mirrored_;  // seen from above: masses near one would lose their last digits
};

}  // namespace taylorcal::calibrate
