#pragma once

#include "solver/sph/packing.hpp"
#include "solver/sph/particles.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace taylorcal::sph {

/// The frozen neighbourhood of every site in the reference state: gradients and forces of
/// total Lagrangian SPH with first-order corrected gradients (Bonet and Lok 1999).
///
/// With w = V_j (-W'/r) and K_i = sum_j w X_ij X_ij^T the gradient of a field f is
/// sum_j w (f_j - f_i) X_ij^T K_i^-1: exact for linear fields, and their least-squares
/// fit otherwise. What the fit misses is the hourglass motion.
///
/// W is that of the rear's lattice throughout, by lattice distance: gradients do not
/// change with the scale of w. What is measured by w itself, the misfit and its damping,
/// is scaled to the local edge: at a share s of the rear's edge the kernel's own w would
/// be s^-5 times as large.
class Reference {
  public:
    /// `hourglass_viscosity` damps what the gradients cannot see, in the rear [Pa s].
    Reference(const Packing& packing, double density, double hourglass_viscosity);

    /// dF/dt of a block's particles from velocities, the rate at which it misses them,
    /// sum_j w (v_ij - Fdot X_ij), and the heat of hourglass damping.
    void velocity_gradient(Particles& particles, std::size_t block,
                           const std::array<Field, 3>& velocity) const;

    /// Accelerations of a block from the stresses Q = P K^-1 in `pull`, of which `share`
    /// counts, from hourglass damping and from the pulls q against the misfit. The
    /// damping force of a pair is minus the derivative of the dissipation c sum_i V_i
    /// sum_j w |v_ij - Fdot_i X_ij|^2 / 2: the correction needs no more than -c Fdot
    /// within Q and the relative velocity, because K-fitted gradients are stationary
    /// points of that sum. The forces of q do the work sum_i V_i q_i . misfit rate: w
    /// (q_i - q_j) on a pair, and -q (sum_j w X_ij)^T within P.
    void accelerate(Particles& particles, std::size_t block, float share = 1) const;
    /// The same where steps differ: the stresses and damping of newly renewed particles
    /// act on all their pairs at once for their whole step, others have acted already. So
    /// the impulses of all pairs add up to nothing, and damping takes what it heats.
    void accelerate(Particles& particles, std::size_t block,
                    const Arrivals& arrivals) const;

    /// (P - q (sum_j w X_ij)^T) K^-1 - c Fdot for one block, from P.
    template <class Vector>
    void store_pull(Particles& particles, std::size_t block,
                    const Vector (&stress)[9]) const;

    /// Mean number of neighbours that a particle has in the reference state.
    double mean_neighbours() const;
    const Field& volume() const { return volume_; }
    /// For every active block the active blocks with which it shares a pair of
    /// neighbours, itself included, by their indices within Packing::active.
    std::vector<std::vector<std::uint32_t>> stencils(const Packing& packing) const;

  private:
    /// The sites of one neighbouring column that a site sees.
    struct NeighbourColumn {
        std::ptrdiff_t offset;           // to the first neighbour's slot
        std::size_t count;               // of neighbours in it
        std::array<float, 5> steepness;  // -W'/r [1/m5]
    };

    template <class Vector>
    void velocity_gradient_in(Particles& particles, std::size_t block,
                              const std::array<Field, 3>& velocity) const;
    void find_neighbours(const Packing& packing);
    void measure_moments(const Packing& packing);
    template <class Vector, class Steps>
    void accelerate_in(const Steps& steps, Particles& particles, std::size_t block) const;

    std::vector<std::size_t> active_;
    std::vector<std::size_t> column_of_block_;
    std::vector<std::vector<NeighbourColumn>> neighbours_;  // by column
    std::array<Field, 3> place_;                            // reference position [m]
    Field volume_;                                          // reference [m3]
    Field specific_volume_;              // 1/density, zero where there is no particle
    std::array<Field, 6> inverse_;       // K^-1: xx yy zz xy xz yz
    Field zeroth_moment_;                // sum_j w [1/m2]
    std::array<Field, 3> first_moment_;  // sum_j w X_ij [1/m]
    Field viscosity_;                    // hourglass, c [Pa s]
};

/// A K^-1 for a row-major A and a symmetric K^-1.
template <class Vector>
inline void times_symmetric(const Vector (&a)[9], const std::array<Field, 6>& k,
                            std::size_t b, Vector (&c)[9]) {
    for (int r = 0; r < 9; r += 3) {
        c[r] = a[r] * k[0][b] + a[r + 1] * k[3][b] + a[r + 2] * k[4][b];
        c[r + 1] = a[r] * k[3][b] + a[r + 1] * k[1][b] + a[r + 2] * k[5][b];
        c[r + 2] = a[r] * k[4][b] + a[r + 1] * k[5][b] + a[r + 2] * k[2][b];
    }
}

template <class Vector>
void Reference::store_pull(Particles& particles, std::size_t block,
                           const Vector (&stress)[9]) const {
    Vector resisted[9], pull[9];
    for (std::size_t c = 0; c < 9; ++c) {
        resisted[c] =
            stress[c] - particles.misfit_pull[c / 3][block] * first_moment_[c % 3][block];
    }
    times_symmetric(resisted, inverse_, block, pull);
    for (std::size_t c = 0; c < 9; ++c) {
        particles.pull[c][block] = pull[c] - viscosity_[block] * particles.rate[c][block];
    }
}

}  // namespace taylorcal::sph
