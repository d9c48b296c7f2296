#pragma once

#include "solver/axisymmetric/body.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace taylorcal::axisymmetric {

/// Keeps the free surface from passing through itself when a head folds onto its rear.
/// Nodes of the outline that are near a segment of it are watched;
/// one that would pass through it gives up its relative normal velocity (an inelastic,
/// frictionless collision that conserves momentum).
class SelfContact {
  public:
    explicit SelfContact(const Body& body);
    /// Corrects the velocities that `accelerate` made, before the nodes move by
    /// `time_step`; the work goes to `balance.contact`.
    void apply(Body& body, double time_step);
    /// Nodes that met another piece of surface since the last call.
    std::vector<std::size_t> take_touching() { return std::exchange(touching_, {}); }

  private:
    struct Pair {
        std::size_t node;     ///< position in the outline
        std::size_t segment;  ///< from this position to the next
        bool behind;          ///< the undeformed node was, as at an edge
    };
    void search(const Body& body);
    /// Whether the undeformed node lies around an edge from a segment, or on its line.
    bool lies_behind(std::size_t node, std::size_t segment) const;

    std::vector<double> reference_radius_, reference_height_;  ///< of its nodes [m]
    std::vector<double> reference_arc_;                        ///< along the outline [m]
    std::vector<Pair> watched_;
    std::vector<std::size_t> touching_;
    double travel_ = 0;  ///< furthest that a node may have moved since the search
    double reach_ = 0;   ///< [m]
    bool searched_ = false;
};

}  // namespace taylorcal::axisymmetric
