#include "calibrate/posterior/mean_shift.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::calibrate {
namespace {

constexpr double smallest_dip = 0.3;
constexpr int most_shifts = 200;

/// Points in units of the kernel's width.
RowMatrix scaled(const RowMatrix& points, const Eigen::RowVectorXd& width) {
    return points.array().rowwise() / width.array();
}

Eigen::RowVectorXd kernel_width(const RowMatrix& points) {
    const auto n = static_cast<double>(points.rows());
    const auto d = static_cast<double>(points.cols());
    const Eigen::RowVectorXd mean = points.colwise().mean();
    const Eigen::RowVectorXd sd =
        ((points.rowwise() - mean).colwise().squaredNorm() / n).cwiseSqrt();
    return (sd * std::pow(4 / ((d + 2) * n), 1 / (d + 4))).cwiseMax(1e-6);
}

Eigen::VectorXd kernel(const RowMatrix& points, const Eigen::RowVectorXd& at) {
    return (-0.5 * (points.rowwise() - at).rowwise().squaredNorm().array()).exp();
}

Eigen::RowVectorXd climb(const RowMatrix& points, Eigen::RowVectorXd at) {
    for (int i = 0; i < most_shifts; ++i) {
        const Eigen::VectorXd weight = kernel(points, at);
        const Eigen::RowVectorXd next = weight.transpose() * points / weight.sum();
        const double moved = (next - at).norm();
        at = next;
        if (moved < 3e-3) break;
    }
    return at;
}

/// Whether the density between two modes hardly dips.
bool is_one_hill(const RowMatrix& points, const Eigen::RowVectorXd& a,
                 const Eigen::RowVectorXd& b) {
    const double lower = std::min(kernel(points, a).sum(), kernel(points, b).sum());
    constexpr int steps = 20;
    for (int i = 1; i < steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        if (kernel(points, (1 - t) * a + t * b).sum() < (1 - smallest_dip) * lower)
            return false;
    }
    return true;
}

}  // namespace

Basins find_basins(const RowMatrix& points) {
    if (points.cols() == 0)
        return {RowMatrix(1, 0),
                std::vector<std::size_t>(static_cast<std::size_t>(points.rows()), 0)};
    const Eigen::RowVectorXd width = kernel_width(points);
    const RowMatrix z = scaled(points, width);
    std::vector<Eigen::RowVectorXd> modes;
    Basins basins;
    for (Eigen::Index i = 0; i < z.rows(); ++i) {
        const Eigen::RowVectorXd top = climb(z, z.row(i));
        std::size_t mode = 0;
        while (mode < modes.size() && (modes[mode] - top).norm() > 0.3 &&
               !is_one_hill(z, modes[mode], top))
            ++mode;
        if (mode == modes.size()) modes.push_back(top);
        if (kernel(z, top).sum() > kernel(z, modes[mode]).sum()) modes[mode] = top;
        basins.member.push_back(mode);
    }
    basins.modes.resize(static_cast<Eigen::Index>(modes.size()), points.cols());
    for (std::size_t m = 0; m < modes.size(); ++m)
        basins.modes.row(static_cast<Eigen::Index>(m)) = modes[m].array() * width.array();
    return basins;
}

}  // namespace taylorcal::calibrate
