#pragma once

#include <cmath>
#include <cstddef>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace taylorcal::material {

/// One 64-byte vector: 16 floats or 8 doubles, one grain a lane. Arithmetic, comparisons
/// and `mask ? a : b` work lane by lane (GCC and clang vector extension).
template <class Real>
struct LaneTraits;
template <>
struct LaneTraits<float> {
    typedef float Vector __attribute__((vector_size(64)));
};
template <>
struct LaneTraits<double> {
    typedef double Vector __attribute__((vector_size(64)));
};

template <class Real>
using Lanes = typename LaneTraits<Real>::Vector;

/// Number of grains in a block.
template <class Real>
inline constexpr std::size_t lane_count = 64 / sizeof(Real);

/// A block with `value` in every lane.
template <class Real>
inline Lanes<Real> broadcast(Real value) {
    return Lanes<Real>{} + value;
}

template <class Vector>
inline Vector lane_max(Vector a, Vector b) {
    return a > b ? a : b;
}

template <class Vector>
inline Vector lane_abs(Vector a) {
    return a < 0 ? -a : a;
}

/// Square root of every lane.
template <class Vector>
inline Vector lane_sqrt(Vector a) {
    constexpr std::size_t count = sizeof(Vector) / sizeof(a[0]);
    for (std::size_t lane = 0; lane < count; ++lane) a[lane] = std::sqrt(a[lane]);
    return a;
}

/// A function of every lane, one by one: not for hot loops.
template <class Vector, class Function>
inline Vector lane_map(Vector a, Function function) {
    constexpr std::size_t count = sizeof(Vector) / sizeof(a[0]);
    for (std::size_t lane = 0; lane < count; ++lane) a[lane] = function(a[lane]);
    return a;
}

/// 1/a and 1/sqrt(a) to rounding (float: within two units in the last place).
template <class Vector>
inline Vector lane_inverse(Vector a) {
    return 1 / a;
}
template <class Vector>
inline Vector lane_inverse_sqrt(Vector a) {
    return 1 / lane_sqrt(a);
}
#ifdef __AVX512F__
// The 14-bit estimates of the processor and one Newton step: several times faster than
// its division and square root, which would dominate the plasticity update.
template <>
inline Lanes<float> lane_inverse(Lanes<float> a) {
    const Lanes<float> estimate = _mm512_maskz_rcp14_ps(0xffff, a);
    return estimate * (2 - a * estimate);
}
template <>
inline Lanes<float> lane_inverse_sqrt(Lanes<float> a) {
    const Lanes<float> estimate = _mm512_maskz_rsqrt14_ps(0xffff, a);
    return estimate * (1.5f - 0.5f * a * estimate * estimate);
}
#endif

/// Whether any lane of a comparison's result is true.
template <class Mask>
inline bool any_lane(Mask mask) {
    constexpr std::size_t count = sizeof(Mask) / sizeof(mask[0]);
    bool any = false;
    for (std::size_t lane = 0; lane < count; ++lane) any |= mask[lane] != 0;
    return any;
}

}  // namespace taylorcal::material
