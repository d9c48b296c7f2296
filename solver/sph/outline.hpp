#pragma once

#include "solver/observe/sizes.hpp"
#include "solver/specimen/shape.hpp"
#include "solver/sph/packing.hpp"
#include "solver/sph/particles.hpp"

#include <vector>

namespace taylorcal::sph {

/// Reads the deformed specimen's outline and lengths off the particles.
///
/// The free surface is a material surface: at each layer's height and at evenly spread
/// angles, a point of the reference surface is carried by the deformation of the nearest
/// particle, x_i + F_i (X - X_i). Averaged over the angles about the layer's own centre
/// (area-equivalent radius) and smoothed along the profile, the outline is quiet, may
/// fold back near the foot, and for the undeformed specimen is the profile itself.
class Outline {
  public:
    Outline(const specimen::Shape& shape, const Packing& packing);

    observe::DeformedProfile measure(const Particles& particles) const;
    /// Radius of the cylinder with the second moment of the lowest layer [m].
    double contact_spot_radius(const Particles& particles) const;

  private:
    /// A point of the reference surface or of a face, carried by a particle.
    struct Tracer {
        std::size_t slot;
        double x, y, z;  // from the particle to the point [m]
    };
    /// Tracers around the outline at one reference height.
    struct Ring {
        std::vector<Tracer> tracers;
        bool smoothed;  // has both neighbours in the same stretch of the profile
        bool rigid;     // moves with its particles but does not deform with them
    };
    /// Where a particle of the layer above carries the head's section: the middle of what
    /// it owns of it.
    struct Piece {
        Tracer middle;
        double share;  // of the section's area
    };

    /// Mean height of the material plane at a reference height within or beside a layer.
    double plane_height(const Particles& particles, std::size_t layer,
                        double height) const;
    double section_height(const Particles& particles) const;
    std::vector<Piece> divide_section(std::size_t layer, double height,
                                      double radius) const;
    Ring make_ring(std::size_t layer, double height, double radius, bool smoothed) const;

    const Packing& packing_;
    std::vector<std::vector<std::size_t>> layer_slots_;
    std::vector<Ring> rings_;
    std::size_t transition_ring_ = 0;
    std::vector<Piece> section_;  // between head and rear
    double initial_length_;
    double initial_rear_radius_;
};

}  // namespace taylorcal::sph
