#include "solver/material/grain_orientations.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal::material;

namespace {

/// Mean over grains and cubic axes of (a . n)^power, 1/(power + 1) for a random
/// polycrystal.
double mean_power(const std::vector<Eigen::Quaterniond>& grains, std::size_t first,
                  std::size_t count, const Eigen::Vector3d& n, int power) {
    double sum = 0;
    for (std::size_t g = first; g < first + count; ++g) {
        const Eigen::Vector3d in_crystal = grains[g].conjugate() * n;
        sum += in_crystal.array().pow(power).sum() / 3;
    }
    return sum / static_cast<double>(count);
}

const Eigen::Vector3d directions[] = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(),
                                      Eigen::Vector3d(1, 2, -1).normalized(),
                                      Eigen::Vector3d(0.1, -1, 3).normalized()};

}  // namespace

TEST_CASE("sixteen grains of a cell are isotropic to the eighth order") {
    const auto grains = grain_orientations(5, 16, 7);
    for (std::size_t point = 0; point < 5; ++point) {
        for (const auto& n : directions) {
            for (const int power : {4, 6, 8})
                CHECK(mean_power(grains, point * 16, 16, n, power) ==
                      Approx(1.0 / (power + 1)).epsilon(1e-9));
        }
    }
}

TEST_CASE("eight grains are nearly isotropic to the fourth order, one grain is not") {
    const auto eight = grain_orientations(5, 8, 7);
    for (std::size_t point = 0; point < 5; ++point) {
        for (const auto& n : directions)
            CHECK(mean_power(eight, point * 8, 8, n, 4) == Approx(0.2).margin(0.002));
    }
    const auto one = grain_orientations(1, 1, 7);
    CHECK(std::abs(mean_power(one, 0, 1, directions[1], 4) - 0.2) > 0.01);
}

TEST_CASE("cells that follow each other cover all rotations evenly") {
    // The mean of n random rotations is a matrix of norm 1/sqrt(n / 3), here 0.31.
    const auto grains = grain_orientations(96, 1, 5);
    for (std::size_t first = 0; first + 32 <= grains.size(); first += 8) {
        Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
        for (std::size_t p = first; p < first + 32; ++p)
            mean += grains[p].toRotationMatrix() / 32;
        CHECK(mean.norm() < 0.16);
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
