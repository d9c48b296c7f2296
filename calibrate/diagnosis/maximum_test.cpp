#include "calibrate/diagnosis/maximum_test.hpp"

#include "calibrate/diagnosis/tail_probability.hpp"
#include "common/random.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace taylorcal::calibrate {
namespace {

constexpr std::uint64_t stream_of_nulls = 0xd1a6;
constexpr std::ptrdiff_t enough_exceedances = 20;

/// W with W W^T = correlation of the normalised columns, without null directions.
Eigen::MatrixXd root_of_correlation(const Eigen::MatrixXd& directions) {
    const Eigen::MatrixXd unit = directions.colwise().normalized();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(unit.transpose() * unit);
    Eigen::Index first = 0;
    while (first < solver.eigenvalues().size() && solver.eigenvalues()(first) < 1e-10)
        ++first;
    const Eigen::Index rank = solver.eigenvalues().size() - first;
    return solver.eigenvectors().rightCols(rank) *
           solver.eigenvalues().tail(rank).cwiseSqrt().asDiagonal();
}

}  // namespace

NormalTable::NormalTable(std::uint64_t seed, Eigen::Index columns, Eigen::Index draws)
    : numbers_(draws, columns) {
    for (Eigen::Index j = 0; j < columns; ++j) {
        const RandomStream stream(
            seed, stream_of_nulls + (static_cast<std::uint64_t>(j) << 32));
        for (Eigen::Index i = 0; i < draws; ++i)
            numbers_(i, j) = stream.normal(static_cast<std::uint64_t>(i));
    }
}

Eigen::Ref<const Eigen::MatrixXd> NormalTable::columns(Eigen::Index count) const {
    return numbers_.leftCols(count);
}

MaximumTest::MaximumTest(const Eigen::MatrixXd& directions, std::vector<Side> sides,
                         const NormalTable& table)
    : sides_(std::move(sides)) {
    if (sides_.empty()) return;
    const Eigen::MatrixXd root = root_of_correlation(directions);
    const Eigen::MatrixXd z = table.columns(root.cols()) * root.transpose();
    maxima_.resize(static_cast<std::size_t>(z.rows()));
    for (Eigen::Index i = 0; i < z.rows(); ++i) {
        double largest = strength(0, z(i, 0));
        for (std::size_t k = 1; k < sides_.size(); ++k)
            largest = std::max(largest, strength(k, z(i, static_cast<Eigen::Index>(k))));
        maxima_[static_cast<std::size_t>(i)] = largest;
    }
    std::sort(maxima_.begin(), maxima_.end());
}

double MaximumTest::strength(std::size_t i, double z) const {
    if (sides_[i] == Side::both) return std::abs(z);
    return sides_[i] == Side::positive ? z : -z;
}

double MaximumTest::probability(double strength) const {
    if (maxima_.empty()) return 1;
    const std::ptrdiff_t above =
        maxima_.end() - std::lower_bound(maxima_.begin(), maxima_.end(), strength);
    const double counted =
        static_cast<double>(above + 1) / static_cast<double>(maxima_.size() + 1);
    if (above >= enough_exceedances) return counted;
    // In the far tail the sum over the statistics is a close upper bound.
    double sum = 0;
    for (const Side side : sides_)
        sum += (side == Side::both ? 2 : 1) * normal_tail(strength);
    return std::min(counted, sum);
}

double MaximumTest::critical(double p) const {
    if (maxima_.empty()) return normal_quantile_of_tail(p);
    const auto n = static_cast<double>(maxima_.size());
    const auto at = static_cast<std::size_t>(std::clamp((1 - p) * n, 0.0, n - 1));
    return maxima_[at];
}

}  // namespace taylorcal::calibrate
