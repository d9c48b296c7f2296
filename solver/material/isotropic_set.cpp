#include "solver/material/isotropic_set.hpp"

#include "common/random.hpp"
#include "solver/material/uniform_rotation.hpp"

#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include <Eigen/Cholesky>

namespace taylorcal::material {
namespace {

constexpr int degree = 8;
constexpr int moment_count = (degree + 1) * (degree + 2) / 2;
constexpr std::uint64_t set_stream = 0x6f7269656e74;
constexpr int most_steps = 60;
constexpr double negligible = 1e-24;  // square of the anisotropy that is rounding
// All turns of a single cubic grain are as anisotropic: without it rounding would choose
// among them, and every machine another one.
constexpr double least_gain = 1e-9;

using Set = std::vector<Eigen::Quaterniond>;
using Moment = Eigen::Matrix<double, moment_count, 1>;

/// A component of the moment: powers of an axis' coordinates, the root of how often it
/// stands in the tensor, its mean over all orientations.
struct Component {
    std::array<int, 3> powers;
    double weight;
    double isotropic;
};

double factorial(int n) { return n > 1 ? n * factorial(n - 1) : 1; }
double double_factorial(int n) { return n > 1 ? n * double_factorial(n - 2) : 1; }

std::vector<Component> components() {
    std::vector<Component> list;
    for (int i = 0; i <= degree; ++i) {
        for (int j = 0; i + j <= degree; ++j) {
            const int k = degree - i - j;
            const double weight = std::sqrt(factorial(degree) /
                                            (factorial(i) * factorial(j) * factorial(k)));
            const bool even = i % 2 == 0 && j % 2 == 0 && k % 2 == 0;
            const double mean = even ? double_factorial(i - 1) * double_factorial(j - 1) *
                                           double_factorial(k - 1) /
                                           double_factorial(degree + 1)
                                     : 0;
            list.push_back({{i, j, k}, weight, 3 * weight * mean});
        }
    }
    return list;
}

/// Sum over the three cubic axes of their weighted eighth powers, less that of a random
/// polycrystal.
Moment anisotropic_moment(const Eigen::Quaterniond& orientation) {
    static const std::vector<Component> list = components();
    const Eigen::Matrix3d axes = orientation.toRotationMatrix();
    std::array<Eigen::Matrix3d, degree + 1> power;
    power[0].setOnes();
    for (std::size_t p = 1; p <= degree; ++p) power[p] = power[p - 1].cwiseProduct(axes);
    Moment moment;
    for (int m = 0; m < moment_count; ++m) {
        const auto& [powers, weight, isotropic] = list[static_cast<std::size_t>(m)];
        Eigen::RowVector3d product = Eigen::RowVector3d::Ones();
        for (int axis = 0; axis < 3; ++axis) {
            const auto p =
                static_cast<std::size_t>(powers[static_cast<std::size_t>(axis)]);
            product = product.cwiseProduct(power[p].row(axis));
        }
        moment[m] = weight * product.sum() - isotropic;
    }
    return moment;
}

Eigen::Quaterniond turned(const Eigen::Quaterniond& orientation,
                          const Eigen::Vector3d& turn) {
    const double angle = turn.norm();
    if (angle == 0) return orientation;
    return (Eigen::AngleAxisd(angle, turn / angle) * orientation).normalized();
}

Moment mean_moment(const Set& set) {
    Moment sum = Moment::Zero();
    for (const auto& orientation : set) sum += anisotropic_moment(orientation);
    return sum / static_cast<double>(set.size());
}

/// Of the mean moment by the turns of each grain about x, y, z.
Eigen::MatrixXd jacobian(const Set& set) {
    constexpr double turn = 1e-6;
    const auto grains = static_cast<Eigen::Index>(set.size());
    Eigen::MatrixXd slope(moment_count, 3 * grains);
    for (Eigen::Index g = 0; g < grains; ++g) {
        const auto& grain = set[static_cast<std::size_t>(g)];
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3d change = turn * Eigen::Vector3d::Unit(axis);
            slope.col(3 * g + axis) = (anisotropic_moment(turned(grain, change)) -
                                       anisotropic_moment(turned(grain, -change))) /
                                      (2 * turn * static_cast<double>(grains));
        }
    }
    return slope;
}

Set turned_set(const Set& set, const Eigen::VectorXd& turns) {
    Set changed = set;
    for (std::size_t g = 0; g < set.size(); ++g)
        changed[g] = turned(set[g], turns.segment<3>(3 * static_cast<Eigen::Index>(g)));
    return changed;
}

/// Levenberg-Marquardt steps from random orientations.
Set search_isotropic_set(std::size_t count) {
    constexpr double first_damping = 1e-2;
    constexpr double most_damping = 1e3;
    const RandomStream random(count, set_stream);
    Set set;
    for (std::size_t g = 0; g < count; ++g) set.push_back(uniform_rotation(random, g));
    Moment moment = mean_moment(set);
    double damping = first_damping;
    for (int step = 0; step < most_steps && moment.squaredNorm() > negligible; ++step) {
        const Eigen::MatrixXd slope = jacobian(set);
        const Eigen::VectorXd gradient = slope.transpose() * moment;
        for (bool gained = false; !gained; damping *= gained ? 0.2 : 4) {
            if (damping > most_damping) return set;
            Eigen::MatrixXd normal = slope.transpose() * slope;
            normal.diagonal().array() += damping;
            const Set trial = turned_set(set, -normal.ldlt().solve(gradient));
            const Moment changed = mean_moment(trial);
            gained = changed.squaredNorm() < (1 - least_gain) * moment.squaredNorm();
            if (!gained) continue;
            set = trial;
            moment = changed;
        }
    }
    return set;
}

}  // namespace

std::vector<Eigen::Quaterniond> isotropic_set(std::size_t count) {
    static std::mutex guard;
    static std::map<std::size_t, Set> known;
    const std::lock_guard lock(guard);
    auto& entry = known[count];
    if (entry.empty()) entry = search_isotropic_set(count);
    return entry;
}

}  // namespace taylorcal::material
