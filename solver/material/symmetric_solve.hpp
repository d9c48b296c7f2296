#pragma once

#include "common/lanes.hpp"

namespace taylorcal::material {

/// Solves A x = b lane by lane for a symmetric positive definite A of order n, given by
/// its lower triangle (row i starts at i (i + 1)/2), by A = L D L^T. `a` is overwritten,
/// `b` becomes x.
template <int n, class Vector>
inline void solve_symmetric(Vector (&a)[n * (n + 1) / 2], Vector (&b)[n]) {
    const auto at = [](int i, int j) { return i * (i + 1) / 2 + j; };
    Vector inverse[n];
#pragma GCC unroll 8
    for (int j = 0; j < n; ++j) {
        Vector diagonal = a[at(j, j)];
#pragma GCC unroll 8
        for (int k = 0; k < j; ++k) {
            // Row j holds L D up to column j - 1; divide out D while it is summed.
            const Vector l = a[at(j, k)] * inverse[k];
            diagonal -= l * a[at(j, k)];
            a[at(j, k)] = l;
        }
        inverse[j] = lane_inverse(diagonal);
#pragma GCC unroll 8
        for (int i = j + 1; i < n; ++i) {
            Vector sum = a[at(i, j)];
#pragma GCC unroll 8
            for (int k = 0; k < j; ++k) sum -= a[at(i, k)] * a[at(j, k)];
            a[at(i, j)] = sum;
        }
    }
#pragma GCC unroll 8
    for (int i = 1; i < n; ++i) {
#pragma GCC unroll 8
        for (int k = 0; k < i; ++k) b[i] -= a[at(i, k)] * b[k];
    }
#pragma GCC unroll 8
    for (int i = 0; i < n; ++i) b[i] *= inverse[i];
#pragma GCC unroll 8
    for (int i = n - 2; i >= 0; --i) {
#pragma GCC unroll 8
        for (int k = i + 1; k < n; ++k) b[i] -= a[at(k, i)] * b[k];
    }
}

}  // namespace taylorcal::material
