#pragma once

#include <numbers>

namespace taylorcal::sph {

/// The M4 cubic spline of support 2h in three dimensions, normalised to one (Monaghan and
/// Lattanzio 1985).
class CubicSpline {
  public:
    explicit CubicSpline(double h) : h_(h), scale_(1 / (std::numbers::pi * h * h * h)) {}

    double support() const { return 2 * h_; }

    /// W(r) [1/length^3].
    double value(double r) const {
        const double q = r / h_;
        if (q >= 2) return 0;
        const double tail = 2 - q;
        return q < 1 ? scale_ * (1 - 1.5 * q * q + 0.75 * q * q * q)
                     : scale_ * 0.25 * tail * tail * tail;
    }

    /// -W'(r)/r, positive; the gradient of W towards a neighbour is this times the
    /// offset.
    double steepness(double r) const {
        const double q = r / h_;
        if (q >= 2) return 0;
        const double tail = 2 - q;
        return scale_ / (h_ * h_) * (q < 1 ? 3 - 2.25 * q : 0.75 * tail * tail / q);
    }

  private:
    double h_;
    double scale_;
};

}  // namespace taylorcal::sph
