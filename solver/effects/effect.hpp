#pragma once

#include "solver/impact/impact_case.hpp"

#include <functional>
#include <string>
#include <vector>

namespace taylorcal::effects {

enum class PriorKind { half_normal, normal };
enum class ActsOn { material, anvil, initial_state, impact };

/// Belief about an amplitude before any measurement; `scale` is the standard deviation
/// of the normal, before halving.
struct Prior {
    PriorKind kind;
    double scale;
};

/// A physical effect that the model lacks and that a run can be given. Its amplitude, in
/// `unit`, is zero where the effect is absent.
struct Effect {
    std::string name;  ///< that users write
    std::string symbol;
    std::string equation;
    std::string unit;
    double lowest;
    double highest;
    Prior prior;
    double typical;  ///< amplitude that shows the effect well
    bool is_signed;  ///< whether the amplitude may be negative
    ActsOn acts_on;
    std::vector<impact::Geometry> geometries;
    bool needs_dislocations;  ///< means nothing to J2 and the like
    std::string description;
    std::string source;  ///< of range and prior
    /// Gives a case the effect: changes its figures, or adds to its additions.
    std::function<void(impact::ImpactCase&, double amplitude)> apply;
};

inline const std::vector<impact::Geometry> both_geometries = {
    impact::Geometry::axisymmetric, impact::Geometry::three_dimensional};

}  // namespace taylorcal::effects
