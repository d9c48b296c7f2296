#include "emulator/inference/dense.hpp"

namespace taylorcal::emulator {

namespace {

template <class V>
constexpr Eigen::Index lanes = lane_count<typename V::Lane>;

/// Some rows of a b: sums of rows x blocks stay in registers while the loop runs down b.
template <class V, int rows, int blocks>
void multiply_rows(const MatrixView<typename V::Lane>& a, Eigen::Index first,
                   const typename V::Lane* b, typename V::Lane* c, Eigen::Index width) {
    for (Eigen::Index column = 0; column < width; column += blocks * lanes<V>) {
        V sum[rows][blocks] = {};
        const typename V::Lane* left = a.data + first * a.row;
        const typename V::Lane* right = b + column;
        for (Eigen::Index k = 0; k < a.columns; ++k) {
            V x[blocks];
#pragma GCC unroll 2
            for (int j = 0; j < blocks; ++j) x[j] = V::load(right + j * lanes<V>);
#pragma GCC unroll 4
            for (int i = 0; i < rows; ++i) {
                const V factor = left[i * a.row];
#pragma GCC unroll 2
                for (int j = 0; j < blocks; ++j) sum[i][j] += factor * x[j];
            }
            left += a.column;
            right += width;
        }
#pragma GCC unroll 4
        for (int i = 0; i < rows; ++i) {
#pragma GCC unroll 2
            for (int j = 0; j < blocks; ++j)
                sum[i][j].store(c + (first + i) * width + column + j * lanes<V>);
        }
    }
}

template <class V>
void multiply_in(const MatrixView<typename V::Lane>& a, const typename V::Lane* b,
                 typename V::Lane* c, Eigen::Index width) {
    // Eight registers of sums hide the latency of the sums.
    constexpr int rows = V::parts <= 2 ? 4 : 2;
    constexpr int blocks = V::parts == 1 ? 2 : 1;
    Eigen::Index first = 0;
    for (; first + rows <= a.rows; first += rows)
        multiply_rows<V, rows, blocks>(a, first, b, c, width);
    for (; first < a.rows; ++first) multiply_rows<V, 1, blocks>(a, first, b, c, width);
}

/// Calls function(x, bias, place) for every block of a matrix [rows x width].
template <class V, class Function>
void for_blocks(const typename V::Lane* x, const typename V::Lane* bias,
                Eigen::Index rows, Eigen::Index width, const Function& function) {
    for (Eigen::Index row = 0; row < rows; ++row) {
        const V shift = bias[row];
        for (Eigen::Index place = row * width; place < (row + 1) * width;
             place += lanes<V>)
            function(V::load(x + place) + shift, place);
    }
}

}  // namespace

template <typename Scalar>
void multiply(const MatrixView<Scalar>& a, const Scalar* b, Scalar* c,
              Eigen::Index width) {
    simd::run([&](auto chosen) {
        multiply_in<Registers<Scalar, chosen.value>>(a, b, c, width);
    });
}

template <typename Scalar>
void activate(Scalar* x, const Scalar* bias, Eigen::Index rows, Eigen::Index width) {
    simd::run([&](auto chosen) {
        using V = Registers<Scalar, chosen.value>;
        for_blocks<V>(x, bias, rows, width, [&](const V& sum, Eigen::Index place) {
            (sum * lane_inverse(1 + lane_exp(-sum))).store(x + place);
        });
    });
}

template <typename Scalar>
void activate(Scalar* x, Scalar* slope, const Scalar* bias, Eigen::Index rows,
              Eigen::Index width) {
    simd::run([&](auto chosen) {
        using V = Registers<Scalar, chosen.value>;
        for_blocks<V>(x, bias, rows, width, [&](const V& sum, Eigen::Index place) {
            const V logistic = lane_inverse(1 + lane_exp(-sum));
            (sum * logistic).store(x + place);
            (logistic * (1 + sum * (1 - logistic))).store(slope + place);
        });
    });
}

template <typename Scalar>
void add_bias(Scalar* x, const Scalar* bias, Eigen::Index rows, Eigen::Index width) {
    simd::run([&](auto chosen) {
        using V = Registers<Scalar, chosen.value>;
        for_blocks<V>(x, bias, rows, width,
                      [&](const V& sum, Eigen::Index place) { sum.store(x + place); });
    });
}

template void multiply(const MatrixView<float>&, const float*, float*, Eigen::Index);
template void multiply(const MatrixView<double>&, const double*, double*, Eigen::Index);
template void activate(float*, const float*, Eigen::Index, Eigen::Index);
template void activate(float*, float*, const float*, Eigen::Index, Eigen::Index);
template void activate(double*, double*, const double*, Eigen::Index, Eigen::Index);
template void add_bias(float*, const float*, Eigen::Index, Eigen::Index);
template void add_bias(double*, const double*, Eigen::Index, Eigen::Index);

}  // namespace taylorcal::emulator
