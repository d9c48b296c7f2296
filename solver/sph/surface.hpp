#pragma once

#include "solver/specimen/shape.hpp"
#include "solver/sph/particles.hpp"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::sph {

/// What a particle carries of the specimen's flank or of the shoulder above a step, in
/// the reference state. The two faces are none of it: nothing folds onto them.
struct SurfaceElement {
    std::size_t slot;
    Eigen::Vector3d normal;  ///< outward, of unit length
    double depth;            ///< of the particle below the surface [m]
};

/// The elements of a packed profile, by layers from the foot.
std::vector<SurfaceElement> surface_elements(const specimen::Shape& shape,
                                             const Packing& packing);

/// An element as its particle has deformed it, by Nanson's relation.
struct DeformedElement {
    Eigen::Matrix3d inverse;  ///< F^-1 over the local edge: to lattice cells [1/m]
    Eigen::Vector3d normal;   ///< F^-T N / |F^-T N|
    double depth;             ///< of the particle below the surface [m]
};
DeformedElement deform(const SurfaceElement& element, const Packing& packing,
                       const Particles& particles);

}  // namespace taylorcal::sph
