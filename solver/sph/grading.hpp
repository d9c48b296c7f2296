#pragma once

#include "solver/specimen/shape.hpp"

#include <cstddef>
#include <vector>

namespace taylorcal::sph {

/// How narrow the lattice is along the axis, as a share of its edge in the rear.
///
/// Thin sections have more than half as many particles across as the rear has: in the
/// head below a step the lattice is narrower throughout. In a cone it widens more slowly
/// than the cone does, so that few columns end on its flank: one with many steps does not
/// fold as a smooth one. Above a step it widens slowly: columns that lean soften a head
/// that collapses.
class Grading {
  public:
    explicit Grading(const specimen::Shape& shape);

    /// At a height within the stretch between the stations `lower` and `lower` + 1.
    double share(std::size_t lower, double height) const;
    /// Length of a stretch in local edges, times the rear's edge [m].
    double stretched_length(std::size_t lower) const;
    /// Height in a stretch that has that much of its stretched length below it [m].
    double height_at(std::size_t lower, double stretched) const;

  private:
    /// In a section by itself.
    double wanted(double radius) const;

    const specimen::Shape& shape_;
    std::vector<double> lowest_share_;            // by stretch
    std::vector<std::vector<double>> stretched_;  // below evenly spread heights
};

}  // namespace taylorcal::sph
