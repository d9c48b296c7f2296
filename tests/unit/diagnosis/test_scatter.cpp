#include "tests/unit/diagnosis/linear_table.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

constexpr double extra_sd = 0.25;  // [mm], twice what the errors of a number say

/// Faces that scatter more than their errors say.
Eigen::VectorXd scattered_faces(const toys::LinearTable& table, std::uint64_t seed) {
    const RandomStream noise(seed, 17);
    Eigen::VectorXd extra = table.no_shift();
    for (Eigen::Index i = 0; i < extra.size(); ++i)
        if (i % 3 == 1) extra(i) = extra_sd * noise.normal(static_cast<std::uint64_t>(i));
    return extra;
}

Diagnosis diagnose_table(const toys::LinearTable& table,
                         const Eigen::VectorXd& measured) {
    const DiagnosisProblem problem = table.problem(measured);
    return diagnose([&](const Eigen::VectorXd&) { return problem; },
                    RowMatrix::Constant(1, 3, 0.5));
}

}  // namespace

TEST_CASE("scatter beyond the stated errors is measured where it is", "[scatter]") {
    const toys::LinearTable table;
    constexpr int tables = 60;
    double found = 0, elsewhere = 0;
    for (std::uint64_t i = 0; i < tables; ++i) {
        const Eigen::VectorXd y =
            table.draw(20000 + i, scattered_faces(table, 20000 + i)) - table.base;
        for (const UnstatedScatter& s : unstated_scatter(table.problem(y), y)) {
            CHECK(s.stated_sd == Approx(std::sqrt(1.5) * table.sd / 20));
            (s.size == "impact_diameter_mm" ? found : elsewhere) +=
                20 * s.over_stated * s.stated_sd / tables;
        }
    }
    CHECK(found == Approx(extra_sd).epsilon(0.2));
    CHECK(elsewhere / 2 < 0.5 * std::sqrt(1.5) * table.sd);
}

TEST_CASE("errors twice as large as stated are told for all sizes", "[scatter]") {
    const toys::LinearTable table;
    constexpr int tables = 40;
    int told = 0, flagged = 0, without = 0;
    for (std::uint64_t i = 0; i < tables; ++i) {
        const Eigen::VectorXd once = table.draw(50000 + i, table.no_shift());
        const Eigen::VectorXd y = table.base + 2 * (once - table.base);
        const Diagnosis found = diagnose_table(table, y);
        told += found.scatter.size() == 3 &&
                verdict_words(table.problem(y), found).find("final length by") !=
                    std::string::npos;
        flagged += found.verdict.is_flagged;
        without += table.diagnose(y).verdict.is_flagged;
    }
    INFO(told << " told, " << flagged << " flagged, " << without << " if not counted");
    CHECK(told >= 0.85 * tables);
    CHECK(without >= 0.85 * tables);
    CHECK(flagged <= 0.15 * tables);
}

TEST_CASE("neither an effect nor a wild number is scatter", "[scatter]") {
    const toys::LinearTable table;
    const Eigen::VectorXd quiet = table.no_shift();
    for (Eigen::Index k = 0; k < 8; ++k) {
        const Eigen::VectorXd effect = table.effects.col(k);
        CHECK(unstated_scatter(table.problem(effect), 20 * effect).empty());
    }
    Eigen::VectorXd wild = quiet;
    wild(3 * 12 + 1) = 5;
    CHECK(unstated_scatter(table.problem(wild), wild).empty());
}

TEST_CASE("what other inputs and lots do to a residual is not scatter", "[scatter]") {
    const toys::LinearTable table;
    const std::string odd = "odd", even = "even";
    Eigen::VectorXd residual = table.no_shift();
    DiagnosisProblem problem = table.problem(residual);
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
        ShotLabel& shot = problem.shots[problem.data[static_cast<std::size_t>(i)].shot];
        const auto at =
            static_cast<double>(problem.data[static_cast<std::size_t>(i)].shot);
        shot.other_inputs = {5 + std::sin(2 * at), 8, 300};
        shot.lot = std::fmod(at, 2) == 0 ? even : odd;
        residual(i) = shot.other_inputs(0) + (shot.lot == odd ? 1 : 0);
    }
    CHECK(unstated_scatter(problem, residual).empty());
    for (ShotLabel& shot : problem.shots) shot.lot = odd;
    CHECK(unstated_scatter(problem, residual).size() == 3);
}

TEST_CASE("tables that scatter more than stated are seldom flagged for it", "[scatter]") {
    const toys::LinearTable table;
    constexpr int tables = 150;
    int flagged = 0, without = 0;
    for (std::uint64_t i = 0; i < tables; ++i) {
        const Eigen::VectorXd y =
            table.draw(30000 + i, scattered_faces(table, 30000 + i));
        flagged += diagnose_table(table, y).verdict.is_flagged;
        without += table.diagnose(y).verdict.is_flagged;
    }
    INFO(flagged << " flagged of " << tables << ", " << without
                 << " if it is not counted");
    CHECK(without > 0.5 * tables);
    CHECK(flagged < 0.25 * without);
}

TEST_CASE("effects are found beside the scatter of a table", "[scatter]") {
    const toys::LinearTable table;
    int flagged = 0, in_set = 0, total = 0, counted = 0;
    for (std::size_t k = 0; k < table.candidates.size(); ++k)
        for (std::uint64_t i = 0; i < 5; ++i) {
            const Eigen::VectorXd g = table.effects.col(static_cast<Eigen::Index>(k));
            const Diagnosis found = diagnose_table(
                table, table.draw(40000 + 100 * k + i, table.amplitude_of(g, 6) * g));
            ++total;
            counted += !found.scatter.empty();
            flagged += found.verdict.is_flagged;
            in_set += std::count(found.verdict.effects.begin(),
                                 found.verdict.effects.end(), k) > 0;
        }
    INFO(flagged << " flagged, " << in_set << " in the set of " << total
                 << ", scatter in " << counted);
    CHECK(flagged >= 0.85 * total);
    CHECK(in_set >= 0.9 * flagged);
}
