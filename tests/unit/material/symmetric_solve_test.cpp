#include "solver/material/symmetric_solve.hpp"

#include "common/lanes.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::material;

TEST_CASE("five equations are solved lane by lane") {
    std::srand(3);
    Lanes<double> a[15];
    Lanes<double> b[5];
    std::vector<Eigen::Matrix<double, 5, 1>> expected;
    for (std::size_t lane = 0; lane < lane_count<double>; ++lane) {
        const Eigen::Matrix<double, 5, 5> root = Eigen::Matrix<double, 5, 5>::Random();
        const Eigen::Matrix<double, 5, 5> matrix =
            root * root.transpose() + Eigen::Matrix<double, 5, 5>::Identity();
        const Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Random();
        for (int i = 0; i < 5; ++i) {
            b[i][lane] = right(i);
            for (int j = 0; j <= i; ++j) a[i * (i + 1) / 2 + j][lane] = matrix(i, j);
        }
        expected.push_back(matrix.partialPivLu().solve(right));
    }
    solve_symmetric<5>(a, b);
    for (std::size_t lane = 0; lane < lane_count<double>; ++lane) {
        for (int i = 0; i < 5; ++i) {
            CHECK(b[i][lane] == Approx(expected[lane](i)).epsilon(1e-10).margin(1e-12));
        }
    }
}
