#include "solver/material/grain_orientations.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal::material;

namespace {

/// Mean over grains and cubic axes of (a . n)^4, 1/5 for a random polycrystal.
double mean_fourth(const std::vector<Eigen::Quaterniond>& grains, std::size_t first,
                   std::size_t count, const Eigen::Vector3d& n) {
    double sum = 0;
    for (std::size_t g = first; g < first + count; ++g) {
        const Eigen::Vector3d in_crystal = grains[g].conjugate() * n;
        sum += in_crystal.array().pow(4).sum() / 3;
    }
    return sum / static_cast<double>(count);
}

}  // namespace

TEST_CASE("a cell's grains are isotropic to the fourth order") {
    const auto grains = grain_orientations(5, 16, 7);
    const Eigen::Vector3d directions[] = {
        Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(),
        Eigen::Vector3d(1, 2, -1).normalized(), Eigen::Vector3d(0.1, -1, 3).normalized()};
    for (std::size_t point = 0; point < 5; ++point) {
        for (const auto& n : directions) {
            CHECK(mean_fourth(grains, point * 16, 16, n) == Approx(0.2).margin(0.002));
        }
    }
}

TEST_CASE("cells differ, seeds differ, and nothing depends on the number of cells") {
    const auto few = grain_orientations(2, 8, 3);
    const auto many = grain_orientations(9, 8, 3);
    const auto other = grain_orientations(2, 8, 4);
    for (std::size_t g = 0; g < few.size(); ++g) {
        CHECK(few[g].coeffs() == many[g].coeffs());
        CHECK(few[g].angularDistance(other[g]) > 1e-3);
    }
    CHECK(few[0].angularDistance(few[8]) > 1e-3);
}
