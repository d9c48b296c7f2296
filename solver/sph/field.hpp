#pragma once

#include "common/lanes.hpp"
#include "solver/sph/packing.hpp"

#include <cstddef>
#include <vector>

namespace taylorcal::sph {

using Vector = Lanes<float>;
static_assert(lane_count<float> == block_size);

/// One number a slot in single precision: by aligned blocks, or by slots from anywhere.
class Field {
  public:
    Field() = default;
    explicit Field(std::size_t slots) : blocks_(slots / block_size) {}

    Vector& operator[](std::size_t block) { return blocks_[block]; }
    const Vector& operator[](std::size_t block) const { return blocks_[block]; }
    const float* lanes() const { return blocks_.data()->data(); }
    float* lanes() { return blocks_.data()->data(); }

  private:
    std::vector<Vector> blocks_;
};

/// A block of doubles rounded to single precision.
inline Vector rounded(const double* first) {
    Vector v;
    for (std::size_t k = 0; k < block_size; ++k) v[k] = static_cast<float>(first[k]);
    return v;
}

/// C = A B of row-major 3x3 matrices, lane by lane.
template <class Vector>
inline void multiply(const Vector (&a)[9], const Vector (&b)[9], Vector (&c)[9]) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            c[3 * i + j] =
                a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
        }
    }
}

/// The inverse of a row-major 3x3 matrix, lane by lane; returns its determinant.
template <class Vector>
inline Vector invert(const Vector (&a)[9], Vector (&inverse)[9]) {
    const Vector c0 = a[4] * a[8] - a[5] * a[7];
    const Vector c1 = a[5] * a[6] - a[3] * a[8];
    const Vector c2 = a[3] * a[7] - a[4] * a[6];
    const Vector determinant = a[0] * c0 + a[1] * c1 + a[2] * c2;
    const Vector d = lane_inverse(determinant);
    inverse[0] = c0 * d;
    inverse[1] = (a[2] * a[7] - a[1] * a[8]) * d;
    inverse[2] = (a[1] * a[5] - a[2] * a[4]) * d;
    inverse[3] = c1 * d;
    inverse[4] = (a[0] * a[8] - a[2] * a[6]) * d;
    inverse[5] = (a[2] * a[3] - a[0] * a[5]) * d;
    inverse[6] = c2 * d;
    inverse[7] = (a[1] * a[6] - a[0] * a[7]) * d;
    inverse[8] = (a[0] * a[4] - a[1] * a[3]) * d;
    return determinant;
}

}  // namespace taylorcal::sph
