#include "emulator/training/covariance.hpp"

#include "common/random.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::emulator;

TEST_CASE("covariances by category tend to the true ones", "[covariance]") {
    constexpr int n = 4000;
    const RandomStream random(1, 1);
    RowMatrix errors(n, 3);
    std::vector<std::string> categories;
    for (int i = 0; i < n; ++i) {
        const auto normal = [&](int k) {
            return random.normal(static_cast<std::uint64_t>(2 * i + k));
        };
        const bool wide = i % 2 == 0;
        const double common = normal(0) * (wide ? 2 : 1);
        errors.row(i) << common, common + normal(1), wide ? std::nan("") : normal(1);
        categories.emplace_back(wide ? "wide" : "narrow");
    }
    const auto result =
        covariances(errors, categories, errors, categories, {"a", "b", "c"});
    REQUIRE(result.size() == 2);
    CHECK(result[0].first == "narrow");
    const Covariance& narrow = result[0].second;
    const Covariance& wide = result[1].second;
    CHECK(wide.outputs == std::vector<std::string>{"a", "b"});
    REQUIRE(narrow.matrix.rows() == 3);
    // var(a), cov(a, b), var(b) are 4, 4, 5 and 1, 1, 2; b and c share normal(1).
    CHECK(wide.matrix(0, 0) == Approx(4).epsilon(0.1));
    CHECK(wide.matrix(0, 1) == Approx(4).epsilon(0.1));
    CHECK(wide.matrix(1, 1) == Approx(5).epsilon(0.1));
    CHECK(narrow.matrix(0, 0) == Approx(1).epsilon(0.1));
    CHECK(narrow.matrix(1, 2) == Approx(1).epsilon(0.1));
    CHECK(narrow.matrix(0, 2) == Approx(0).margin(0.1));
}

TEST_CASE("a covariance stays positive however few rows there are", "[covariance]") {
    RowMatrix errors(2, 3);
    errors << 1, std::nan(""), 1, std::nan(""), 1, -1;
    const std::vector<std::string> categories = {"x", "x"};
    const RowMatrix known = RowMatrix::Ones(2, 3);
    const auto result =
        covariances(errors, categories, known, categories, {"a", "b", "c"});
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(result[0].second.matrix);
    CHECK(solver.eigenvalues().minCoeff() > 0);
}
