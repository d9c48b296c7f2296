#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::material {

/// `count` orientations of a cubic crystal whose mean is as isotropic as can be: the
/// eighth moment of their cubic axes, which holds all anisotropy of degrees 4, 6 and 8,
/// is as near to a random polycrystal's as damped Gauss-Newton steps bring it. From 16
/// grains on nothing is left but rounding. The same on each call.
std::vector<Eigen::Quaterniond> isotropic_set(std::size_t count);

}  // namespace taylorcal::material
