#include "calibrate/comparison/groups.hpp"
#include "calibrate/diagnosis/unexplained.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <catch2/catch.hpp>
#include <fmt/core.h>

using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;

namespace {

/// Nine shots of each shape at 100, 110 ... 180 m/s. All residuals are `usual` standard
/// errors but those of the fast third of the second shape, which are `odd`.
std::vector<ResidualGroup> groups_of(const std::vector<std::string>& shapes, double usual,
                                     double odd) {
    std::vector<Shot> table;
    for (const std::string& shape : shapes)
        for (int i = 0; i < 9; ++i) {
            table.push_back(toys::shot(fmt::format("{}{}", shape, i), "lot",
                                       100 + 10.0 * i, {{"final_length_mm", 20, 0.1}}));
            table.back().shape = shape;
        }
    const DataSet set = make_data_set(table, {"final_length_mm"});
    std::vector<ShotComparison> shots;
    for (const Datum& datum : set.data) {
        const bool is_odd =
            datum.shot.shape == shapes.back() && datum.shot.velocity_m_s > 155;
        ShotComparison shot;
        shot.datum = &datum;
        shot.whitened = Eigen::VectorXd::Constant(1, is_odd ? odd : usual);
        shot.standardised = shot.whitened;
        shot.residual = 0.1 * shot.whitened;
        shots.push_back(shot);
    }
    const auto n = std::ssize(shots);
    const Eigen::MatrixXd independent = Eigen::MatrixXd::Identity(n, n);
    return group_residuals(shots, set.sizes, {independent, independent});
}

ResidualGroup find(const std::vector<ResidualGroup>& groups, const std::string& key) {
    for (const ResidualGroup& group : groups)
        if (group.key == key) return group;
    FAIL("no group " + key);
    return {};
}

}  // namespace

TEST_CASE("a group by shape, size and third is named with its shape", "[comparison]") {
    const auto groups = groups_of({"uniform_cylinder", "reduced_head_4mm"}, 0.2, -3);
    const ResidualGroup odd = find(groups, "reduced_head_4mm x final_length_mm x high");
    CHECK(odd.n == 3);
    CHECK(odd.shape == "reduced_head_4mm");
    CHECK(odd.mean_whitened == Approx(-3));
    CHECK_THAT(odd.words, Contains("4-mm head, final length predicted 1.5 % too long at "
                                   "high velocity"));
    const ResidualGroup usual = find(groups, "uniform_cylinder x final_length_mm x high");
    CHECK(usual.mean_whitened == Approx(0.2));
    CHECK_THAT(usual.words, Contains("uniform cylinder, final length within the errors"));
    CHECK(find(groups, "final_length_mm").shape.empty());
}

TEST_CASE("the one shape of a table is not repeated in every group", "[comparison]") {
    const auto groups = groups_of({"uniform_cylinder"}, 0.2, -3);
    const ResidualGroup odd = find(groups, "uniform_cylinder x final_length_mm x high");
    CHECK(odd.shape.empty());
    CHECK_THAT(odd.words, Catch::Matchers::StartsWith("final length predicted"));
}

TEST_CASE("comparison and diagnosis cut the velocities alike", "[comparison]") {
    std::vector<Shot> table;
    struct NoModel final : DiagnosisModel {
        taylorcal::RowMatrix predict(const taylorcal::RowMatrix&) const override {
            return {};
        }
        taylorcal::RowMatrix shift(std::size_t, const taylorcal::RowMatrix&,
                                   const Eigen::VectorXd&) const override {
            return {};
        }
        Eigen::MatrixXd shift_covariance(std::size_t) const override { return {}; }
        RunRange run_range(std::size_t) const override { return {}; }
        std::string why_unseen(std::size_t) const override { return ""; }
    };
    const NoModel model;
    DiagnosisProblem problem{model};
    for (int i = 0; i < 10; ++i) {
        table.push_back(toys::shot(fmt::format("s{}", i), "lot", 100 + 10.0 * i,
                                   {{"final_length_mm", 20, 0.1}}));
        problem.shots.push_back(
            {table.back().id, table.back().shape, "lot", table.back().velocity_m_s});
        problem.data.push_back({problem.shots.size() - 1, "final_length_mm", 20});
    }
    const DataSet set = make_data_set(table, {"final_length_mm"});
    std::vector<ShotComparison> shots;
    for (const Datum& datum : set.data) {
        ShotComparison shot;
        shot.datum = &datum;
        shot.whitened = shot.standardised = shot.residual = Eigen::VectorXd::Zero(1);
        shots.push_back(shot);
    }
    const Eigen::MatrixXd independent = Eigen::MatrixXd::Identity(10, 10);
    const auto groups = group_residuals(shots, set.sizes, {independent, independent});
    const Unexplained unexplained =
        describe_unexplained(problem, Eigen::VectorXd::Zero(10));
    REQUIRE(unexplained.pattern.size() == 3);
    for (const Unexplained::Cell& cell : unexplained.pattern)
        CHECK(find(groups, cell.velocity_third).n == cell.n);
    CHECK(find(groups, "low").n == 3);
}
