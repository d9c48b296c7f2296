#pragma once

#include "common/lanes.hpp"

#include <cstddef>

namespace taylorcal::calibrate {

// The arithmetic of a dense layer over a narrow block of draws: one row a neuron, one
// column a draw. It differs from emulator/inference/dense.hpp in that the activation is
// applied to sums while they are in registers, and in its cheaper SiLU.

/// Draws that go through the network together, so that two layers stay in the first
/// cache.
inline constexpr std::size_t chunk_width = 128;

/// Columns are taken in groups of this size, for every variant.
inline constexpr std::size_t column_step = 32;

/// Rows of a weight matrix that share a register tile.
inline constexpr std::size_t most_tile_rows = 6;

/// 1/a to 3e-7 (relative), for a >= 1.
template <class V>
inline V quick_inverse(const V& a) {
    return lane_inverse(a);
}
#ifdef TAYLORCAL_SIMD_VARIANTS
template <std::size_t lanes>
inline Estimable8<lanes> quick_inverse(const Estimable8<lanes>& a) {
    Estimable8<lanes> estimate;
    estimate_inverse(a, estimate);
    return estimate + estimate * (1 - a * estimate);
}
#endif

/// t / (1 + 2^t). With t = -x log2(e) it is silu(x) times -log2(e): the scale of the
/// hidden layers passes through their weights, so that only the first and the last carry
/// it. The error is below 1e-6 max(1, |t|) (2^r by a polynomial of degree 5 that is
/// within 8e-8 on [-1/2, 1/2]).
template <class V>
inline V scaled_silu(const V& t) {
    const V edge = 80;
    const V capped = -lane_max(-lane_max(t, -edge), -edge);
    // Adding it leaves the nearest integer in the lowest bits.
    const V shift = 0x1.8p23f;
    const V shifted = capped + shift;
    const V r = capped - (shifted - shift);
    const V fraction =
        ((((1.3276476e-3f * r + 9.6755419e-3f) * r + 5.5507131e-2f) * r + 2.4022120e-1f) *
             r +
         6.9314694e-1f) *
            r +
        1.0000001f;
    return t * quick_inverse(1 + lane_times_power_of_two(fraction, shifted));
}

/// `rows` rows of [weights] x [from] + bias over all columns; weights packed as
/// weights[k * rows + i].
template <class V, int rows, bool activated>
inline void tile(const float* weights, const float* bias, std::size_t inner,
                 const float* from, float* to, std::size_t columns) {
    constexpr int blocks = 2;
    for (std::size_t column = 0; column < columns; column += blocks * V::lanes) {
        V sum[rows][blocks];
#pragma GCC unroll 6
        for (int i = 0; i < rows; ++i) sum[i][0] = sum[i][1] = V(bias[i]);
        const float* weight = weights;
        const float* x = from + column;
        for (std::size_t k = 0; k < inner; ++k, weight += rows, x += chunk_width) {
            const V x0 = V::load(x), x1 = V::load(x + V::lanes);
#pragma GCC unroll 6
            for (int i = 0; i < rows; ++i) {
                const V factor = weight[i];
                sum[i][0] += factor * x0;
                sum[i][1] += factor * x1;
            }
        }
#pragma GCC unroll 6
        for (int i = 0; i < rows; ++i) {
#pragma GCC unroll 2
            for (int j = 0; j < blocks; ++j) {
                const V out = activated ? scaled_silu(sum[i][j]) : sum[i][j];
                out.store(to + static_cast<std::size_t>(i) * chunk_width + column +
                          static_cast<std::size_t>(j) * V::lanes);
            }
        }
    }
}

/// Rows are dealt to tiles as evenly as can be: 21 as 6 + 5 + 5 + 5.
inline std::size_t next_tile(std::size_t rows_left) {
    const std::size_t tiles = (rows_left + most_tile_rows - 1) / most_tile_rows;
    return (rows_left + tiles - 1) / tiles;
}

/// A whole layer. `weights` as `pack_tiles` lays them out.
template <class V, bool activated>
inline void dense_layer(const float* weights, const float* bias, std::size_t rows,
                        std::size_t inner, const float* from, float* to,
                        std::size_t columns) {
    for (std::size_t row = 0; row < rows;) {
        const std::size_t size = next_tile(rows - row);
        float* out = to + row * chunk_width;
        switch (size) {
            case 1:
                tile<V, 1, activated>(weights, bias + row, inner, from, out, columns);
                break;
            case 2:
                tile<V, 2, activated>(weights, bias + row, inner, from, out, columns);
                break;
            case 3:
                tile<V, 3, activated>(weights, bias + row, inner, from, out, columns);
                break;
            case 4:
                tile<V, 4, activated>(weights, bias + row, inner, from, out, columns);
                break;
            case 5:
                tile<V, 5, activated>(weights, bias + row, inner, from, out, columns);
                break;
            default:
                tile<V, 6, activated>(weights, bias + row, inner, from, out, columns);
        }
        weights += size * inner;
        row += size;
    }
}

}  // namespace taylorcal::calibrate
