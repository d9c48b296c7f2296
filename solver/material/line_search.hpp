#pragma once

#include "common/lanes.hpp"

#include <limits>

namespace taylorcal::material {

/// Halves Newton's steps, lane by lane, where they made the residual larger. The
/// equations are those of a convex potential, so that this cannot fail; plain steps do
/// where drag saturates and thousands of times too many dislocations wait to slip.
template <class V>
class LineSearch {
  public:
    /// Looks at the residual at e: where it grew, the next step goes half way back.
    void turn_back(const V (&e)[5], const V (&residual)[5]) {
        V square = {};
        for (int k = 0; k < 5; ++k) square += residual[k] * residual[k];
        for (int k = 0; k < 5; ++k)
            best_[k] = lane_select(square > smallest_, best_[k], e[k]);
        worse_ = lane_select(square > smallest_, V(1), V(0));
        smallest_ = lane_select(square > smallest_, smallest_, square);
    }
    /// Component k of the next e, given Newton's change of it.
    V step(int k, const V& e, const V& change) const {
        return lane_select(worse_ > 0, (e + best_[k]) / 2, e + change);
    }

  private:
    V best_[5] = {};
    V smallest_ = std::numeric_limits<typename V::Lane>::max();
    V worse_ = {};
};

}  // namespace taylorcal::material
