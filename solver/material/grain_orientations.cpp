#include "solver/material/grain_orientations.hpp"

#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

namespace taylorcal::material {
namespace {

constexpr std::size_t moment_count = 15;
constexpr std::uint64_t set_stream = 0x6f7269656e74;  // of the search, same for all seeds
constexpr std::uint64_t cell_stream = 0x63656c6c;
constexpr std::uint64_t change_stream = 0x74657874;
constexpr std::uint64_t search_steps = 20000;

using Moment = std::array<double, moment_count>;

/// Sum over the three cubic axes a of the monomials of degree 4 of (a_x, a_y, a_z), each
/// weighted by the root of its multiplicity in a_i a_j a_k a_l.
Moment fourth_moment(const Eigen::Quaterniond& orientation) {
    const Eigen::Matrix3d axes = orientation.toRotationMatrix();
    constexpr std::array<double, 5> factorial = {1, 1, 2, 6, 24};
    Moment moment{};
    std::size_t m = 0;
    for (int i = 0; i <= 4; ++i) {
        for (int j = 0; i + j <= 4; ++j, ++m) {
            const int k = 4 - i - j;
            const double multiplicity =
                factorial[4] / (factorial[static_cast<std::size_t>(i)] *
                                factorial[static_cast<std::size_t>(j)] *
                                factorial[static_cast<std::size_t>(k)]);
            for (int axis = 0; axis < 3; ++axis) {
                moment[m] += std::sqrt(multiplicity) * std::pow(axes(0, axis), i) *
                             std::pow(axes(1, axis), j) * std::pow(axes(2, axis), k);
            }
        }
    }
    return moment;
}

/// The same averaged over all orientations: 3/5 of (1/3 sym delta delta).
Moment isotropic_moment() {
    Moment moment{};
    std::size_t m = 0;
    for (int i = 0; i <= 4; ++i) {
        for (int j = 0; i + j <= 4; ++j, ++m) {
            const int k = 4 - i - j;
            if (i == 4 || j == 4 || k == 4)
                moment[m] = 3.0 / 5;
            else if (i % 2 == 0 && j % 2 == 0 && k % 2 == 0)
                moment[m] = std::sqrt(6.0) / 5;
        }
    }
    return moment;
}

double anisotropy(const Moment& sum, double count) {
    static const Moment isotropic = isotropic_moment();
    double square = 0;
    for (std::size_t m = 0; m < moment_count; ++m) {
        square += std::pow(sum[m] / count - isotropic[m], 2);
    }
    return square;
}

// All turns of a single cubic grain are as anisotropic: without it rounding would choose
// among them, and every machine another one.
constexpr double least_gain = 1 - 1e-9;

/// A set of `count` orientations with little anisotropy, by a random search that keeps
/// what improves, with ever smaller turns.
std::vector<Eigen::Quaterniond> search_isotropic_set(std::size_t count) {
    const RandomStream random(count, set_stream);
    std::vector<Eigen::Quaterniond> set;
    std::vector<Moment> moments;
    Moment sum{};
    for (std::size_t g = 0; g < count; ++g) {
        set.push_back(uniform_rotation(random, g));
        moments.push_back(fourth_moment(set.back()));
        for (std::size_t m = 0; m < moment_count; ++m) sum[m] += moments[g][m];
    }
    double best = anisotropy(sum, static_cast<double>(count));
    for (std::uint64_t step = 0; step < search_steps; ++step) {
        const std::size_t g = step % count;
        const std::uint64_t base = 3 * count + 3 * step;
        const double size = 0.5 * std::pow(1e-4, static_cast<double>(step) /
                                                     static_cast<double>(search_steps));
        const Eigen::Vector3d turn(random.normal(base), random.normal(base + 1),
                                   random.normal(base + 2));
        const Eigen::Quaterniond trial =
            (Eigen::AngleAxisd(size * turn.norm(), turn.normalized()) * set[g])
                .normalized();
        const Moment moment = fourth_moment(trial);
        Moment changed = sum;
        for (std::size_t m = 0; m < moment_count; ++m)
            changed[m] += moment[m] - moments[g][m];
        const double value = anisotropy(changed, static_cast<double>(count));
        if (!(value < least_gain * best)) continue;
        best = value;
        set[g] = trial;
        moments[g] = moment;
        sum = changed;
    }
    return set;
}

}  // namespace

Eigen::Quaterniond uniform_rotation(const RandomStream& random, std::uint64_t index) {
    const double u = random.uniform(3 * index);
    const double first = 2 * std::numbers::pi * random.uniform(3 * index + 1);
    const double second = 2 * std::numbers::pi * random.uniform(3 * index + 2);
    return {std::sqrt(u) * std::cos(second), std::sqrt(1 - u) * std::sin(first),
            std::sqrt(1 - u) * std::cos(first), std::sqrt(u) * std::sin(second)};
}

std::vector<Eigen::Quaterniond> isotropic_set(std::size_t count) {
    static std::mutex guard;
    static std::map<std::size_t, std::vector<Eigen::Quaterniond>> known;
    const std::lock_guard lock(guard);
    auto& entry = known[count];
    if (entry.empty()) entry = search_isotropic_set(count);
    return entry;
}

Eigen::Quaterniond changed_orientation(const std::vector<OrientationChange>& changes,
                                       const Eigen::Quaterniond& drawn,
                                       std::uint64_t seed, std::uint64_t point,
                                       std::size_t grain, std::size_t per_point) {
    Eigen::Quaterniond orientation = drawn;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const RandomStream random(seed, change_stream + i);
        const double offset = static_cast<double>(grain) / static_cast<double>(per_point);
        double whole = 0;
        const double uniform = std::modf(random.uniform(point) + offset, &whole);
        orientation = changes[i](orientation, uniform);
    }
    return orientation;
}

std::vector<Eigen::Quaterniond> grain_orientations(
    std::size_t points, std::size_t per_point, std::uint64_t seed,
    const std::vector<OrientationChange>& changes) {
    const std::vector<Eigen::Quaterniond> set = isotropic_set(per_point);
    const RandomStream random(seed, cell_stream);
    std::vector<Eigen::Quaterniond> orientations;
    orientations.reserve(points * per_point);
    for (std::size_t point = 0; point < points; ++point) {
        const Eigen::Quaterniond rotation = uniform_rotation(random, point);
        for (std::size_t g = 0; g < per_point; ++g)
            orientations.push_back(changed_orientation(changes, rotation * set[g], seed,
                                                       point, g, per_point));
    }
    return orientations;
}

}  // namespace taylorcal::material
