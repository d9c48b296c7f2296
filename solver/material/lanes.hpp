#pragma once

#include <cmath>
#include <cstddef>

namespace taylorcal::material {

/// One 64-byte vector: 16 floats or 8 doubles, one grain a lane. Arithmetic and
/// comparisons work lane by lane (GCC and clang vector extension).
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

}  // namespace taylorcal::material
