#pragma once

#include <vector>

#include <Eigen/Core>

namespace taylorcal::sph {

/// A neighbour of a particle in the reference state.
struct Neighbour {
    Eigen::Vector3d offset;  ///< X_ij [m]
    double volume;           ///< V_j [m3]
};

/// Weights c_ij of a particle's misfit sum_j c_ij (f_j - f_i), which measures how far a
/// field is from a quadratic one [1/m2].
///
/// c_ij = V_j (1 - a . p(X_ij)) / (2 V edge^2), where V is the mean of V_j, p are the
/// nine monomials of first and second order, and a makes sum_j c_ij p(X_ij) vanish
/// (nearly, for those of second order). What is left of a constant by its fit is a
/// difference of fourth order where the neighbourhood is whole. It is largest for the two
/// interlaced lattices moving against each other, which no gradient sees. Weights that
/// leave linear fields alone, but not quadratic ones, resist bulging as well: sizes then
/// move twice as much with the hourglass coefficient. Where that is one, hourglass motion
/// meets about the stiffness that waves of its length have in the metal.
std::vector<double> misfit_weights(const std::vector<Neighbour>& neighbours, double edge);

}  // namespace taylorcal::sph
