#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <utility>

namespace taylorcal::material {

inline constexpr std::size_t slip_system_count = 12;

/// Components of a symmetric deviator in the orthonormal basis
/// {(xx-yy)/sqrt2, (2zz-xx-yy)/sqrt6, sqrt2 xy, sqrt2 xz, sqrt2 yz}, so that A : B = a .
/// b.
using Deviator = std::array<double, 5>;

/// Schmid tensors M^d = sym(bhat x n) of the twelve fcc systems {111}<110> in the crystal
/// frame, as deviators; |M^d|^2 = 1/2 (Eq. 8).
inline constexpr std::array<Deviator, slip_system_count> schmid_tensors = [] {
    constexpr int planes[4][3] = {{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}};
    constexpr int directions[6][3] = {{0, 1, -1}, {1, 0, -1}, {1, -1, 0},
                                      {0, 1, 1},  {1, 0, 1},  {1, 1, 0}};
    std::array<Deviator, slip_system_count> made{};
    std::size_t system = 0;
    for (const auto& n : planes) {
        for (const auto& b : directions) {
            if (n[0] * b[0] + n[1] * b[1] + n[2] * b[2] != 0) continue;
            constexpr double root12 = 2 * std::numbers::sqrt3;
            const int xx = b[0] * n[0], yy = b[1] * n[1], zz = b[2] * n[2];
            made[system++] = {(xx - yy) / root12, (2 * zz - xx - yy) / 6.0,
                              (b[0] * n[1] + b[1] * n[0]) / root12,
                              (b[0] * n[2] + b[2] * n[0]) / root12,
                              (b[1] * n[2] + b[2] * n[1]) / root12};
        }
    }
    return made;
}();

template <class Real>
inline constexpr std::array<std::array<Real, 5>, slip_system_count>
    rounded_schmid_tensors = [] {
        std::array<std::array<Real, 5>, slip_system_count> rounded{};
        for (std::size_t d = 0; d < slip_system_count; ++d)
            for (std::size_t k = 0; k < 5; ++k)
                rounded[d][k] = static_cast<Real>(schmid_tensors[d][k]);
        return rounded;
    }();

/// Calls work(std::integral_constant<std::size_t, d>()) for every system d: compilers
/// leave out what the zeros of a tensor known to them multiply.
template <class Work>
inline void for_each_slip_system(const Work& work) {
    [&]<std::size_t... d>(std::index_sequence<d...>) {
        (work(std::integral_constant<std::size_t, d>()), ...);
    }
    (std::make_index_sequence<slip_system_count>());
}

/// M^d : A of a deviator.
template <std::size_t d, class V>
inline V resolve(const V (&deviator)[5]) {
    constexpr auto& m = rounded_schmid_tensors<typename V::Lane>[d];
    V sum = 0;
#pragma GCC unroll 5
    for (std::size_t k = 0; k < m.size(); ++k)
        if (m[k] != 0) sum += m[k] * deviator[k];
    return sum;
}

}  // namespace taylorcal::material
