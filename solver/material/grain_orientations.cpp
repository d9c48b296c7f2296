#include "solver/material/grain_orientations.hpp"

#include "common/random.hpp"
#include "solver/material/isotropic_set.hpp"
#include "solver/material/uniform_rotation.hpp"

#include <array>
#include <cmath>

namespace taylorcal::material {
namespace {

constexpr std::uint64_t cell_stream = 0x63656c6c;
constexpr std::uint64_t change_stream = 0x74657874;

/// Rotation of a point's set. Those of neighbours, which share a load, cover all
/// rotations evenly: an additive recurrence of low discrepancy in three dimensions
/// (powers of the root of x^4 = x + 1; Roberts 2018), begun where the seed says.
Eigen::Quaterniond rotation_of_point(std::uint64_t seed, std::size_t point) {
    constexpr double root = 1.2207440846057596;
    const RandomStream random(seed, cell_stream);
    std::array<double, 3> place{};
    double stride = 1;
    for (std::size_t i = 0; i < place.size(); ++i) {
        stride /= root;
        double whole = 0;
        place[i] =
            std::modf(random.uniform(i) + static_cast<double>(point) * stride, &whole);
    }
    return rotation_of(place);
}

}  // namespace

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
    std::vector<Eigen::Quaterniond> orientations;
    orientations.reserve(points * per_point);
    for (std::size_t point = 0; point < points; ++point) {
        const Eigen::Quaterniond rotation = rotation_of_point(seed, point);
        for (std::size_t g = 0; g < per_point; ++g)
            orientations.push_back(changed_orientation(changes, rotation * set[g], seed,
                                                       point, g, per_point));
    }
    return orientations;
}

}  // namespace taylorcal::material
