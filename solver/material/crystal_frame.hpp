#pragma once

#include "common/lanes.hpp"

namespace taylorcal::material {

// Between the lab frame and the crystal frames of a block of grains. An orientation R
// (row-major) maps crystal to lab vectors; deviators have the components of
// slip_systems.hpp.

/// R <- exp(W dt) R with W = antisym(L), by the Cayley map, which is a rotation exactly.
template <class V, class Real>
inline void rotate_with_spin(const V (&l)[9], Real dt, V (&r)[9]) {
    // Axial vector of W dt/2.
    const V a0 = (l[7] - l[5]) * (dt / 4);
    const V a1 = (l[2] - l[6]) * (dt / 4);
    const V a2 = (l[3] - l[1]) * (dt / 4);
    const V f = 2 / (1 + a0 * a0 + a1 * a1 + a2 * a2);
    for (int column = 0; column < 3; ++column) {
        const V x = r[column];
        const V y = r[3 + column];
        const V z = r[6 + column];
        // c = a x v; v <- v + f (c + a x c)
        const V c0 = a1 * z - a2 * y;
        const V c1 = a2 * x - a0 * z;
        const V c2 = a0 * y - a1 * x;
        r[column] = x + f * (c0 + a1 * c2 - a2 * c1);
        r[3 + column] = y + f * (c1 + a2 * c0 - a0 * c2);
        r[6 + column] = z + f * (c2 + a0 * c1 - a1 * c0);
    }
}

/// dev(D) in the crystal frame, and div v.
template <class V>
inline void strain_rate_in_crystal(const V (&r)[9], const V (&l)[9], V (&rate)[5],
                                   V& dilatation) {
    dilatation = l[0] + l[4] + l[8];
    const V xy = (l[1] + l[3]) / 2;
    const V xz = (l[2] + l[6]) / 2;
    const V yz = (l[5] + l[7]) / 2;
    V t[9];  // D R
    for (int j = 0; j < 3; ++j) {
        t[j] = l[0] * r[j] + xy * r[3 + j] + xz * r[6 + j];
        t[3 + j] = xy * r[j] + l[4] * r[3 + j] + yz * r[6 + j];
        t[6 + j] = xz * r[j] + yz * r[3 + j] + l[8] * r[6 + j];
    }
    const auto entry = [&](int i, int j) -> V {
        return r[i] * t[j] + r[3 + i] * t[3 + j] + r[6 + i] * t[6 + j];
    };
    const V xx = entry(0, 0);
    const V yy = entry(1, 1);
    const V zz = entry(2, 2);
    constexpr double root2 = 1.41421356237309504880;
    constexpr double root6 = 2.44948974278317809820;
    rate[0] = (xx - yy) / root2;
    rate[1] = (2 * zz - xx - yy) / root6;
    rate[2] = root2 * entry(0, 1);
    rate[3] = root2 * entry(0, 2);
    rate[4] = root2 * entry(1, 2);
}

/// A crystal-frame deviator as lab-frame tensor: xx yy zz xy xz yz.
template <class V>
inline void deviator_in_lab(const V (&r)[9], const V (&a)[5], V (&lab)[6]) {
    constexpr double inverse_root2 = 0.70710678118654752440;
    constexpr double inverse_root6 = 0.40824829046386301637;
    const V xx = a[0] * inverse_root2 - a[1] * inverse_root6;
    const V yy = -a[0] * inverse_root2 - a[1] * inverse_root6;
    const V zz = 2 * inverse_root6 * a[1];
    const V xy = a[2] * inverse_root2;
    const V xz = a[3] * inverse_root2;
    const V yz = a[4] * inverse_root2;
    V t[9];  // R S
    for (int i = 0; i < 3; ++i) {
        t[3 * i] = r[3 * i] * xx + r[3 * i + 1] * xy + r[3 * i + 2] * xz;
        t[3 * i + 1] = r[3 * i] * xy + r[3 * i + 1] * yy + r[3 * i + 2] * yz;
        t[3 * i + 2] = r[3 * i] * xz + r[3 * i + 1] * yz + r[3 * i + 2] * zz;
    }
    const auto entry = [&](int i, int j) -> V {
        return t[3 * i] * r[3 * j] + t[3 * i + 1] * r[3 * j + 1] +
               t[3 * i + 2] * r[3 * j + 2];
    };
    lab[0] = entry(0, 0);
    lab[1] = entry(1, 1);
    lab[2] = entry(2, 2);
    lab[3] = entry(0, 1);
    lab[4] = entry(0, 2);
    lab[5] = entry(1, 2);
}

}  // namespace taylorcal::material
