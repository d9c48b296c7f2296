#include "solver/sph/misfit.hpp"

#include <Eigen/Dense>

namespace taylorcal::sph {

namespace {

using Monomials = Eigen::Matrix<double, 9, 1>;

// Of the mean square of a monomial. At an edge of the specimen there are hardly more
// neighbours than monomials: a fit that may be exact would leave nothing to resist.
// Linear ones are fitted exactly all the same, so that nothing resists a rotation.
constexpr double ridge = 1e-2;

Monomials monomials(const Eigen::Vector3d& x) {
    Monomials p;
    p << x, x.cwiseAbs2(), x(0) * x(1), x(0) * x(2), x(1) * x(2);
    return p;
}

}  // namespace

std::vector<double> misfit_weights(const std::vector<Neighbour>& neighbours,
                                   double edge) {
    Eigen::Matrix<double, 9, 9> products = Eigen::Matrix<double, 9, 9>::Zero();
    Monomials sums = Monomials::Zero();
    double volume = 0;
    for (const Neighbour& n : neighbours) {
        const Monomials p = monomials(n.offset / edge);
        products += n.volume * p * p.transpose();
        sums += n.volume * p;
        volume += n.volume;
    }
    products.diagonal().tail<6>().array() += ridge * products.trace() / 9;
    const Monomials a = products.ldlt().solve(sums);
    const double mean_volume = volume / static_cast<double>(neighbours.size());
    std::vector<double> weights;
    weights.reserve(neighbours.size());
    for (const Neighbour& n : neighbours) {
        weights.push_back(n.volume / mean_volume *
                          (1 - a.dot(monomials(n.offset / edge))) / (2 * edge * edge));
    }
    return weights;
}

}  // namespace taylorcal::sph
