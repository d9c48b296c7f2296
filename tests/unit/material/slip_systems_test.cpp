#include "solver/material/slip_systems.hpp"

#include <cmath>

#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace taylorcal::material;

namespace {

Eigen::Matrix3d tensor_from_deviator(const Deviator& deviator) {
    const double root2 = std::sqrt(2.0);
    const double root6 = std::sqrt(6.0);
    Eigen::Matrix3d tensor;
    tensor(0, 0) = deviator[0] / root2 - deviator[1] / root6;
    tensor(1, 1) = -deviator[0] / root2 - deviator[1] / root6;
    tensor(2, 2) = 2 * deviator[1] / root6;
    tensor(0, 1) = tensor(1, 0) = deviator[2] / root2;
    tensor(0, 2) = tensor(2, 0) = deviator[3] / root2;
    tensor(1, 2) = tensor(2, 1) = deviator[4] / root2;
    return tensor;
}

}  // namespace

TEST_CASE(
    "the twelve Schmid tensors are unit systems on distinct planes and directions") {
    const auto& systems = schmid_tensors;
    for (const Deviator& m : systems) {
        double square = 0;
        for (const double component : m) square += component * component;
        CHECK(square == Approx(0.5));
        const Eigen::Matrix3d tensor = tensor_from_deviator(m);
        CHECK(tensor.trace() == Approx(0).margin(1e-15));
        CHECK(tensor.determinant() == Approx(0).margin(1e-15));  // a simple shear
    }
    for (std::size_t a = 0; a < systems.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            double product = 0;
            for (std::size_t k = 0; k < 5; ++k) product += systems[a][k] * systems[b][k];
            CHECK(std::abs(product) < 0.5 - 1e-9);
        }
    }
}

TEST_CASE("together they are cubic: sum of M M is diagonal in the deviator basis") {
    // For the fcc systems sum_d M^d x M^d has the value 4 M_xx^2-type on the two diagonal
    // components and another on the three shears, and nothing between them.
    double sum[5][5] = {};
    for (const Deviator& m : schmid_tensors) {
        for (std::size_t i = 0; i < 5; ++i) {
            for (std::size_t j = 0; j < 5; ++j) sum[i][j] += m[i] * m[j];
        }
    }
    for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t j = 0; j < 5; ++j) {
            if (i != j) CHECK(sum[i][j] == Approx(0).margin(1e-14));
        }
    }
    CHECK(sum[0][0] == Approx(sum[1][1]));
    CHECK(sum[2][2] == Approx(sum[3][3]));
    CHECK(sum[2][2] == Approx(sum[4][4]));
    CHECK(2 * sum[0][0] + 3 * sum[2][2] == Approx(6));  // trace: 12 x 1/2
}
