#include "solver/sph/orientations.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

sph::Packing bar() {
    return sph::pack(specimen::make_shape(specimen::uniform_cylinder, 8e-3, 40e-3), 1e-3);
}

}  // namespace

TEST_CASE("orientations are uniform over all rotations", "[orientations]") {
    const auto orientations = sph::random_orientations(7, bar(), 2);
    // For a uniform rotation the mean of R_ij is 0 and of R_ij^2 is 1/3.
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero(), squares = Eigen::Matrix3d::Zero();
    for (const Eigen::Quaterniond& q : orientations) {
        CHECK(q.norm() == Approx(1).epsilon(1e-12));
        const Eigen::Matrix3d r = q.toRotationMatrix();
        mean += r / static_cast<double>(orientations.size());
        squares += r.cwiseProduct(r) / static_cast<double>(orientations.size());
    }
    CHECK(mean.cwiseAbs().maxCoeff() < 0.03);
    CHECK((squares.array() - 1.0 / 3).abs().maxCoeff() < 0.02);
}

TEST_CASE("a quarter turn carries the orientations onto each other", "[orientations]") {
    const sph::Packing packing = bar();
    const auto orientations = sph::random_orientations(7, packing, 1);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const auto first_of_column = [&](int ix, int iy) {
        for (std::size_t index = 0; index < packing.active.size(); ++index) {
            for (const sph::Column& column : packing.columns) {
                if (column.ix == ix && column.iy == iy &&
                    column.first_slot == packing.active[index] * sph::block_size) {
                    return orientations[index * sph::block_size].toRotationMatrix();
                }
            }
        }
        return Eigen::Matrix3d::Zero().eval();
    };
    const Eigen::Matrix3d here = first_of_column(3, 1);
    CHECK(here.determinant() == Approx(1));
    CHECK((turn * here - first_of_column(-1, 3)).norm() < 1e-12);
    CHECK((turn * turn * here - first_of_column(-3, -1)).norm() < 1e-12);
    CHECK((here - first_of_column(3, 3)).norm() > 0.1);
}
