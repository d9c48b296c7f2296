#pragma once

namespace taylorcal::material {

/// How long grains wait for their cell or particle. Its stable step is that of sound and
/// strains flattened metal by some 1e-5, whereas the grains' equations, which cost most,
/// bear more. Between two moves of the grains the strain is elastic less what slip takes:
/// as over the last move, in proportion to the power of the strain rate, since metal that
/// flows faster slips faster. The next move takes the whole time at its mean velocity
/// gradient and mends what was wrong.
///
/// Strained or turned by so much, the grains move: sizes differ by less than orientation
/// seeds make them from those of grains that move every step. Soft metal bears less, for
/// the stress that a prediction misses must be a small part of its own.
struct GrainStepLimits {
    static constexpr double largest_strain = 4e-4;
    static constexpr double least_strain = 3e-5;
    static constexpr double share_of_elastic = 0.1;
    static constexpr double share_of_slip = 4;  ///< of the last move's, between two moves
};

}  // namespace taylorcal::material
