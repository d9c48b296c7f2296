#pragma once

#include "common/lanes.hpp"

#include <Eigen/Core>

namespace taylorcal::emulator {

// The arithmetic of dense layers, for what the machine runs. Matrices are row-major; a
// `width` is a number of columns that has been padded and is also the distance of rows.

/// The next multiple of what the loops take at a time.
template <typename Scalar>
constexpr Eigen::Index padded(Eigen::Index columns) {
    constexpr auto step = static_cast<Eigen::Index>(2 * lane_count<Scalar>);
    return (columns + step - 1) / step * step;
}

/// A matrix in place: entry (i, j) is at data[i * row + j * column].
template <typename Scalar>
struct MatrixView {
    const Scalar* data;
    Eigen::Index rows, columns;
    Eigen::Index row, column;
};

/// c [a.rows x width] = a b, with b [a.columns x width].
template <typename Scalar>
void multiply(const MatrixView<Scalar>& a, const Scalar* b, Scalar* c,
              Eigen::Index width);

/// x <- silu(x + bias), with x [rows x width], bias [rows] and silu(x) = x/(1 + exp(-x)),
/// the network's activation.
template <typename Scalar>
void activate(Scalar* x, const Scalar* bias, Eigen::Index rows, Eigen::Index width);

/// The same, and the slope of silu there.
template <typename Scalar>
void activate(Scalar* x, Scalar* slope, const Scalar* bias, Eigen::Index rows,
              Eigen::Index width);

/// x <- x + bias.
template <typename Scalar>
void add_bias(Scalar* x, const Scalar* bias, Eigen::Index rows, Eigen::Index width);

}  // namespace taylorcal::emulator
