#pragma once

#include "common/lanes.hpp"

#include <cmath>
#include <numbers>

namespace taylorcal::material {

// The drag balance B V / (1 - V^2/ct^2)^(3/2) = X (Eq. 12) in dimensionless form:
// zeta = X/(ct B) >= 0, v = V/ct. With z = v/sqrt(1 - v^2) it is z^3 + z = zeta, whose
// Cardano root the paper prints; that form loses all digits for small zeta, these do not.

/// One Newton step for z^3 + z = zeta, given `steepness` = 1/(3 z^2 + 1). The cubic is
/// convex for z > 0, so that from the second step on the iterates fall monotonically to
/// the root, from any start.
template <class Vector>
inline Vector drag_root_step(Vector zeta, Vector z, Vector steepness) {
    return (zeta + 2 * z * z * z) * steepness;
}

/// The root itself, z = (2/sqrt 3) sinh(asinh(1.5 sqrt 3 zeta)/3); lane by lane, and kept
/// out of the loops that seldom need it.
template <class Vector>
[[gnu::noinline, gnu::cold]] void find_drag_root(const Vector& zeta, Vector& z) {
    z = lane_map(zeta, [](auto x) {
        using Real = decltype(x);
        constexpr double root_3 = std::numbers::sqrt3;
        return static_cast<Real>(2 / root_3) *
               std::sinh(std::asinh(static_cast<Real>(1.5 * root_3) * x) / 3);
    });
}

/// 1/(3 z^2 + 1): the tangent slope dv/dzeta is it times the secant slope v/zeta.
template <class Vector>
inline Vector drag_steepness(Vector z) {
    return lane_inverse(3 * z * z + 1);
}

/// 1/sqrt(1 + z^2): v = V/ct is z times it, the secant slope v/zeta its cube.
template <class Vector>
inline Vector drag_contraction(Vector z) {
    return lane_inverse_sqrt(1 + z * z);
}

}  // namespace taylorcal::material
