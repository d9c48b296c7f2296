#pragma once

#include "solver/axisymmetric/body.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace taylorcal::axisymmetric {

/// Which cells take which time step. The flat cells of a foot or a folded head have a
/// stable step up to fifty times smaller than the rest; each cell's step is the shortest
/// one times the largest power of two that its own stability allows, so that all meet at
/// the end of a cycle. Neighbours differ by a factor of two at most, for fear of
/// resonance between impulses and the finer cells' own oscillations.
class LocalSteps {
  public:
    explicit LocalSteps(const Body& body);

    /// The cells that share a block of grains take one step together.
    struct Group {
        std::size_t first, last;  ///< cells first ... last - 1
        int level;                ///< its step is the shortest times 2^level
    };

    /// Deals out the steps of the next cycle, which takes no more than `left` (about) to
    /// the end of the run; to be called when all cells have met. The cells of the nodes
    /// `touching` another surface take the shortest step: one-sided contact would rectify
    /// the jolts of unequal ones. Returns the shortest step [s].
    double assign(const Body& body, double left,
                  const std::vector<std::size_t>& touching);

    /// Number of shortest steps in a cycle.
    int cycle() const { return 1 << deepest_; }
    /// Whether a group updates at the end of the shortest step `step` (from 1) of a
    /// cycle.
    static bool ends_at(const Group& group, int step) {
        return step % (1 << group.level) == 0;
    }
    const std::vector<Group>& groups() const { return groups_; }

  private:
    void limit_to_neighbours(const Body& body, const std::vector<std::size_t>& touching);

    std::vector<Group> groups_;
    std::vector<int> node_level_;
    double last_shortest_ = std::numeric_limits<double>::infinity();  ///< stable step [s]
    int deepest_ = 0;
};

}  // namespace taylorcal::axisymmetric
