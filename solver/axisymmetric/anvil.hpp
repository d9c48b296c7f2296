#pragma once

#include "solver/axisymmetric/mesh.hpp"
#include "solver/impact/additions.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace taylorcal::axisymmetric {

struct Body;

/// The anvil beyond the rigid, frictionless plane: Coulomb friction, and a face that
/// recedes from each node at a velocity proportional to the pressure there.
class Anvil {
  public:
    Anvil(const Mesh& mesh, const impact::Additions& additions);

    bool rigid_and_smooth() const { return friction_ == 0 && compliance_ == 0; }

    /// `axisymmetric::accelerate` on this anvil.
    void accelerate(Body& body, double time_step);

    /// How far the face has receded under a node [m].
    double recession(std::size_t node) const { return face_.empty() ? 0 : -face_[node]; }

  private:
    static constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();
    double surface_area(const Body& body, std::size_t node) const;

    double friction_;
    double compliance_;                 // [m/s/Pa]
    std::vector<std::size_t> surface_;  // nodes from the foot's axis to the rear's rim
    std::vector<std::size_t> place_;    // of each node in it
    std::vector<double> face_;          // height of the anvil under each node [m]
};

}  // namespace taylorcal::axisymmetric
