#pragma once

#include <array>

#include <Eigen/Core>

namespace taylorcal::material {

inline constexpr int slip_system_count = 12;

/// Components of a symmetric deviator in the orthonormal basis
/// {(xx-yy)/sqrt2, (2zz-xx-yy)/sqrt6, sqrt2 xy, sqrt2 xz, sqrt2 yz}, so that A : B = a .
/// b.
using Deviator = std::array<double, 5>;

Deviator deviator_from_tensor(const Eigen::Matrix3d& tensor);
Eigen::Matrix3d tensor_from_deviator(const Deviator& deviator);

/// Schmid tensors M^d = sym(bhat x n) of the twelve fcc systems {111}<110> in the crystal
/// frame, as deviators; |M^d|^2 = 1/2 (Eq. 8).
const std::array<Deviator, slip_system_count>& schmid_tensors();

}  // namespace taylorcal::material
