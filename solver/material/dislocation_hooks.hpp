#pragma once

#include "solver/material/dislocation_strength.hpp"

#include <algorithm>

namespace taylorcal::material {

// The members of DislocationStrength that call hooks; for its own file alone. They are
// kept out of the hot loops and get copies of the loops' vectors: one whose address is
// taken stays in memory, and the last bits of what is computed with it may differ.

template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::change(const GrainChanges& changes) {
    hooks_ = changes.hooks;
    if (changes.immobile_factor.empty()) return;
    constexpr std::size_t lanes = lane_count<Real>;
    for (std::size_t n = 0; n < blocks_.size(); ++n) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t grain =
                std::min(n * lanes + lane, changes.immobile_factor.size() - 1);
            for (V& density : blocks_[n].immobile)
                density[lane] *= static_cast<Real>(changes.immobile_factor[grain]);
        }
    }
}

/// The block as hooks see it.
template <class Real, simd::Variant variant>
[[gnu::noinline, gnu::cold]] GrainBlock DislocationStrength<Real, variant>::seen(
    const Block& block) {
    GrainBlock view;
    view.lanes = lane_count<Real>;
    const auto copy = [](const V& from, LaneValues& to) {
        for (std::size_t lane = 0; lane < lane_count<Real>; ++lane)
            to[lane] = static_cast<double>(from[lane]);
    };
    copy(block.temperature, view.temperature);
    copy(block.shear_modulus, view.shear_modulus);
    copy(block.annihilated_energy, view.annihilated_energy);
    for (std::size_t k = 0; k < 5; ++k) copy(block.plastic[k], view.plastic_strain[k]);
    for (std::size_t d = 0; d < slip_system_count; ++d) {
        copy(block.mobile[d], view.mobile[d]);
        copy(block.immobile[d], view.immobile[d]);
    }
    return view;
}

/// Sets what Eq. 20 adds its hardening to such that Ys is what the hooks make of it.
template <class Real, simd::Variant variant>
[[gnu::noinline, gnu::cold]] void DislocationStrength<Real, variant>::change_resistance(
    Block& block) const {
    GrainBlock view = seen(block);
    const double scale = parameters_.hardening_coefficient * parameters_.burgers_vector;
    LaneValues hardening{};
    for (std::size_t lane = 0; lane < view.lanes; ++lane) {
        double total = 0;
        for (const LaneValues& density : view.immobile) total += density[lane];
        hardening[lane] = scale * view.shear_modulus[lane] * std::sqrt(total);
        view.slip_resistance[lane] = parameters_.initial_yield_stress + hardening[lane];
    }
    for (const GrainHook& hook : hooks_.slip_resistance) hook(view);
    for (std::size_t lane = 0; lane < view.lanes; ++lane)
        block.initial_resistance[lane] = static_cast<Real>(
            std::max(view.slip_resistance[lane], 0.0) - hardening[lane]);
}

/// Slip answers to S - X, which is 2 G (e - X/2G): with e moved by -X/2G for the substep
/// its equations stay as they are.
template <class Real, simd::Variant variant>
[[gnu::noinline, gnu::cold]] void DislocationStrength<Real, variant>::lean_back(
    Block& block, Lean& lean) const {
    GrainBlock view = seen(block);
    for (const GrainHook& hook : hooks_.back_stress) hook(view);
    for (std::size_t k = 0; k < 5; ++k) {
        for (std::size_t lane = 0; lane < view.lanes; ++lane)
            lean.elastic[k][lane] = static_cast<Real>(view.back_stress[k][lane] /
                                                      (2 * view.shear_modulus[lane]));
        block.elastic[k] -= lean.elastic[k];
        lean.plastic[k] = block.plastic[k];
    }
}

/// Moves e back, and tells the power of the back stress, which is part of S : wdot.
template <class Real, simd::Variant variant>
[[gnu::noinline, gnu::cold]] void DislocationStrength<Real, variant>::straighten(
    const Lean& lean, Real duration, Block& block, V& power) const {
    V work = {};
    for (std::size_t k = 0; k < 5; ++k) {
        block.elastic[k] += lean.elastic[k];
        work += lean.elastic[k] * (block.plastic[k] - lean.plastic[k]);
    }
    power = 2 * block.shear_modulus * work / duration;
}

template <class Real, simd::Variant variant>
[[gnu::noinline, gnu::cold]] void DislocationStrength<Real, variant>::change_densities(
    Block& block, Real duration, const Slip& slip) const {
    GrainBlock view = seen(block);
    view.duration = static_cast<double>(duration);
    for (std::size_t d = 0; d < slip_system_count; ++d)
        for (std::size_t lane = 0; lane < view.lanes; ++lane)
            view.slip_speed[d][lane] = static_cast<double>(slip.speed[d][lane]);
    for (const GrainHook& hook : hooks_.densities) hook(view);
    for (std::size_t d = 0; d < slip_system_count; ++d) {
        for (std::size_t lane = 0; lane < view.lanes; ++lane) {
            block.mobile[d][lane] =
                static_cast<Real>(std::max(view.mobile[d][lane], 1.0));
            block.immobile[d][lane] =
                static_cast<Real>(std::max(view.immobile[d][lane], 1.0));
        }
    }
}

template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::before_slip(Block& block, Lean& lean) const {
    if (!hooks_.slip_resistance.empty()) change_resistance(block);
    if (!hooks_.back_stress.empty()) lean_back(block, lean);
}

template <class Real, simd::Variant variant>
void DislocationStrength<Real, variant>::after_slip(const Lean& lean, const Step& step,
                                                    Block& block, Slip& slip) const {
    if (!hooks_.back_stress.empty()) {
        V power;
        straighten(lean, step.duration, block, power);
        slip.power += power;
    }
    if (block.slips && !hooks_.densities.empty())
        change_densities(block, step.duration, Slip(slip));
}

}  // namespace taylorcal::material
