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
/// fit otherwise. W is that of the rear's lattice throughout, by lattice distance:
/// gradients do not change with the scale of w. What no gradient sees, the hourglass
/// motion, is measured by the misfit sum_j c v_ij (see misfit_weights).
class Reference {
  public:
    Reference(const Packing& packing, double density);

    /// dF/dt of a block's particles and their misfit, from velocities.
    void velocity_gradient(Particles& particles, std::size_t block,
                           const std::array<Field, 3>& velocity) const;

    /// Accelerations of a block from the stresses Q = P K^-1 in `pull` and from the pulls
    /// q against the misfit, of which `share` counts. Their forces do the work sum_i V_i
    /// (P_i : Fdot_i + q_i . misfit rate).
    void accelerate(Particles& particles, std::size_t block, float share = 1) const;
    /// The same where steps differ: the stresses of newly renewed particles act on all
    /// their pairs at once for their whole step, others have acted already. So the
    /// impulses of all pairs add up to nothing.
    void accelerate(Particles& particles, std::size_t block,
                    const Arrivals& arrivals) const;

    /// P K^-1 for one block, from P.
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
    /// Calls visit(pair, neighbour's slot, steepness) for the particles that one sees;
    /// pairs are counted through its column's list.
    template <class Visit>
    void visit_neighbours(std::size_t slot, const Visit& visit) const;
    void measure_moments(const Packing& packing);
    void measure_misfits(const Packing& packing);
    template <class Vector, class Steps>
    void accelerate_in(const Steps& steps, Particles& particles, std::size_t block) const;

    std::vector<std::size_t> active_;
    std::vector<std::size_t> column_of_block_;
    std::vector<std::vector<NeighbourColumn>> neighbours_;  // by column
    std::array<Field, 3> place_;                            // reference position [m]
    Field volume_;                                          // reference [m3]
    Field specific_volume_;                // 1/density, zero where there is no particle
    std::array<Field, 6> inverse_;         // K^-1: xx yy zz xy xz yz
    std::array<Field, 3> first_moment_;    // sum_j w X_ij [1/m]
    std::vector<std::size_t> first_pair_;  // by block
    std::vector<Vector> misfit_weight_;    // c_ij, by a block's pairs [1/m2]
    std::vector<Vector> reaction_weight_;  // c_ji V_j/V_i, by a block's pairs [1/m2]
    Field weight_sum_;                     // sum_j c_ij [1/m2]
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
    Vector pull[9];
    times_symmetric(stress, inverse_, block, pull);
    for (std::size_t c = 0; c < 9; ++c) particles.pull[c][block] = pull[c];
}

}  // namespace taylorcal::sph
