#pragma once

#include "solver/material/lanes.hpp"

#include <limits>

namespace taylorcal::material {

/// Halves Newton's steps, lane by lane, where they made the residual larger. The
/// equations are those of a convex potential, so that this cannot fail; plain steps do
/// where drag saturates and thousands of times too many dislocations wait to slip.
template <class Real>
class LineSearch {
  public:
    /// Looks at the residual at e: where it grew, the next step goes half way back.
    void turn_back(const Lanes<Real> (&e)[5], const Lanes<Real> (&residual)[5]) {
        Lanes<Real> square = {};
        for (int k = 0; k < 5; ++k) square += residual[k] * residual[k];
        for (int k = 0; k < 5; ++k) best_[k] = square > smallest_ ? best_[k] : e[k];
        worse_ = square > smallest_ ? broadcast<Real>(1) : broadcast<Real>(0);
        smallest_ = square > smallest_ ? smallest_ : square;
    }
    /// Component k of the next e, given Newton's change of it.
    Lanes<Real> step(int k, Lanes<Real> e, Lanes<Real> change) const {
        return worse_ > 0 ? (e + best_[k]) / 2 : e + change;
    }

  private:
    Lanes<Real> best_[5] = {};
    Lanes<Real> smallest_ = broadcast<Real>(std::numeric_limits<Real>::max());
    Lanes<Real> worse_ = {};
};

}  // namespace taylorcal::material
