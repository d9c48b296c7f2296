#pragma once

#include "solver/material/line_search.hpp"
#include "solver/material/mobility.hpp"
#include "solver/material/slip_systems.hpp"
#include "solver/material/symmetric_solve.hpp"

#include <algorithm>
#include <cstddef>

namespace taylorcal::material {

// Newton's last step may be this long: what it leaves is of the order of its square.
template <class Real>
constexpr Real strain_tolerance = sizeof(Real) == 4 ? Real(5e-6) : Real(1e-12);

/// The backward-Euler equations of a few grains' elastic strain e,
/// e + dt sum_d M^d b rhoD V(e) sign = e_old + dt dev(D), Eqs. 4-14, together with the
/// drag roots of the twelve systems: by Newton's method. The grains fill one register,
/// for its sums do not fit into more than the processor has.
template <class V>
class SlipEquations {
  public:
    using Real = typename V::Lane;

    V two_g;                      ///< 2 G [Pa]
    V threshold;                  ///< of the resolved stress [Pa]
    V scale;                      ///< zeta per Pa of excess stress
    V sound_speed;                ///< transverse, ct [m/s]
    V slope_scale;                ///< dt b ct scale 2G
    V slip_scale;                 ///< dt b
    V old[5];                     ///< e at the start
    V trial[5];                   ///< e_old + dt dev(D)
    V mobile[slip_system_count];  ///< rhoD [1/m2]
    V root[slip_system_count];    ///< drag roots z: a guess, and what they become

    V e[5];                       ///< a guess, and the answer
    V speed[slip_system_count];   ///< |V| [m/s]
    V excess[slip_system_count];  ///< |resolved stress| above the threshold [Pa]

    /// Finds e from a guess; at most `largest_iteration_count` iterations.
    void solve() {
        LineSearch<V> search;
        for (int iteration = 0; iteration < largest_iteration_count; ++iteration) {
            const bool careful = iteration >= first_careful_iteration;
            if (iteration == first_careful_iteration) std::copy(old, old + 5, e);
            if (careful) find_roots(*this);
            V jacobian[15];  // lower triangle of I + dt 2G sum_d rhoD dV/dX b^2 M M
            V residual[5];
            for (int i = 0; i < 15; ++i) jacobian[i] = 0;
            for (int k = 0; k < 5; ++k) {
                jacobian[k * (k + 1) / 2 + k] = 1;
                residual[k] = trial[k] - e[k];
            }
            for_each_slip_system(
                [&](auto d) { add_system<d.value>(jacobian, residual); });
            if (careful) search.turn_back(e, residual);
            solve_symmetric<5>(jacobian, residual);
            V change = 0;
            for (int k = 0; k < 5; ++k) {
                const V next =
                    careful ? search.step(k, e[k], residual[k]) : e[k] + residual[k];
                change = lane_max(change, lane_abs(next - e[k]));
                e[k] = next;
            }
            if (!any_lane(change > strain_tolerance<Real>)) break;
        }
    }

  private:
    static constexpr int largest_iteration_count = 100;
    // From this iteration on roots of the drag law are exact and steps may only improve.
    static constexpr int first_careful_iteration = 12;

    template <std::size_t d>
    V excess_of(V& stress) const {
        stress = two_g * resolve<d>(e);
        return lane_max(lane_abs(stress) - threshold, V(0));
    }

    template <std::size_t d>
    void add_system(V (&jacobian)[15], V (&residual)[5]) {
        constexpr auto& m = rounded_schmid_tensors<Real>[d];
        V stress;
        const V above = excess_of<d>(stress);
        const V steepness = drag_steepness(root[d]);
        const V z = drag_root_step(scale * above, root[d], steepness);
        const V contraction = drag_contraction(z);
        const V fast = sound_speed * z * contraction;
        speed[d] = fast;
        excess[d] = above;
        root[d] = lane_select(above > 0, z, V(0));
        const V slope = lane_select(
            above > 0,
            slope_scale * mobile[d] * steepness * contraction * contraction * contraction,
            V(0));
        const V size = slip_scale * mobile[d] * fast;
        const V strain = lane_select(stress < 0, -size, size);
#pragma GCC unroll 5
        for (std::size_t i = 0; i < 5; ++i) {
            if (m[i] == 0) continue;
            residual[i] -= m[i] * strain;
#pragma GCC unroll 5
            for (std::size_t j = 0; j <= i; ++j)
                if (m[j] != 0) jacobian[i * (i + 1) / 2 + j] += m[i] * m[j] * slope;
        }
    }

    /// Exact roots, which the step of `add_system` then leaves as they are.
    [[gnu::noinline, gnu::cold]] static void find_roots(SlipEquations& equations) {
        for_each_slip_system([&](auto d) {
            V stress;
            const V above = equations.template excess_of<d.value>(stress);
            find_drag_root(equations.scale * above, equations.root[d.value]);
        });
    }
};

}  // namespace taylorcal::material
