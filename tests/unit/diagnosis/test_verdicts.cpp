#include "calibrate/diagnosis/competition.hpp"
#include "tests/unit/diagnosis/linear_table.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;

namespace {

bool names(const Verdict& verdict, std::size_t k) {
    return std::count(verdict.effects.begin(), verdict.effects.end(), k) > 0;
}

}  // namespace

TEST_CASE("sound tables are flagged no more often than alpha", "[verdict]") {
    const toys::LinearTable table;
    constexpr int tables = 400;
    int flagged = 0;
    for (int i = 0; i < tables; ++i) {
        const auto seed = static_cast<std::uint64_t>(1000 + i);
        if (table.diagnose(table.draw(seed, table.no_shift())).verdict.is_flagged)
            ++flagged;
    }
    const double limit = tables * 0.05 + 2 * std::sqrt(tables * 0.05 * 0.95);
    INFO(flagged << " of " << tables);
    CHECK(flagged <= limit);
    // The four tests share alpha but overlap: not so strict that power is thrown away.
    CHECK(flagged >= 2);
}

TEST_CASE("an effect of six sigma is flagged and named", "[verdict]") {
    const toys::LinearTable table;
    int flagged = 0, in_set = 0, wrong_single = 0, total = 0, covered = 0;
    for (std::size_t k = 0; k < table.candidates.size(); ++k)
        for (std::uint64_t i = 0; i < 15; ++i) {
            const Eigen::VectorXd g = table.effects.col(static_cast<Eigen::Index>(k));
            const double amplitude = table.amplitude_of(g, 6);
            const ModeDiagnosis found =
                table.diagnose(table.draw(5000 + 100 * k + i, amplitude * g));
            ++total;
            const EffectEvidence& e = *found.candidates[k].evidence;
            covered += e.interval.lower95 <= amplitude && amplitude <= e.interval.upper95;
            if (!found.verdict.is_flagged) continue;
            ++flagged;
            in_set += names(found.verdict, k);
            wrong_single += found.verdict.effects.size() == 1 && !names(found.verdict, k);
        }
    INFO(flagged << " flagged, " << in_set << " in the set, " << wrong_single
                 << " wrong of " << total);
    CHECK(flagged >= 0.85 * total);
    CHECK(in_set >= 0.95 * flagged);
    CHECK(wrong_single <= 0.05 * flagged);
    CHECK(covered >= 0.9 * total);
}

TEST_CASE("effects that look alike are reported together", "[verdict]") {
    toys::LinearTable table;
    // Effect 1 becomes effect 0 with a little of its own: cosine about 0.99 after
    // projection.
    const Eigen::VectorXd g = table.effects.col(0);
    const Eigen::VectorXd other =
        table.effects.col(3) *
        (table.amplitude_of(table.effects.col(3), 1) / table.amplitude_of(g, 1));
    table.effects.col(1) = g + 0.1 * other;
    int together = 0, total = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const ModeDiagnosis found =
            table.diagnose(table.draw(300 + i, table.amplitude_of(g, 7) * g));
        CHECK(std::abs(found.cosine(0, 1)) > 0.98);
        if (!found.verdict.is_flagged) continue;
        ++total;
        together += names(found.verdict, 0) && names(found.verdict, 1) &&
                    found.verdict.kind == VerdictKind::one_of;
    }
    REQUIRE(total >= 17);
    CHECK(together >= total - 1);
}

TEST_CASE("an effect that the parameters imitate is not judged", "[verdict]") {
    toys::LinearTable table;
    table.effects.col(4) =
        0.3 * table.slope * Eigen::Vector3d(1, -2, 0.5) + 0.02 * table.effects.col(4);
    const ModeDiagnosis found = table.diagnose(table.draw(11, 5 * table.effects.col(4)));
    CHECK(found.candidates[4].screening.identifiability < 0.1);
    CHECK(found.candidates[4].abstain);
    CHECK_FALSE(found.candidates[4].evidence);
    CHECK_FALSE(names(found.verdict, 4));
}

TEST_CASE("what no candidate resembles is said to be outside the list", "[verdict]") {
    // Two candidates only, and a misfit of one size of the cones.
    const toys::LinearTable table(2);
    Eigen::VectorXd hidden = table.no_shift();
    for (Eigen::Index i = 0; i < hidden.size(); ++i)
        if (table.is_cone(i) && i % 3 == 1) hidden(i) = table.sd;
    int flagged = 0, outside = 0;
    constexpr int tables = 40;
    for (int i = 0; i < tables; ++i) {
        const auto seed = static_cast<std::uint64_t>(7000 + i);
        const ModeDiagnosis found =
            table.diagnose(table.draw(seed, table.amplitude_of(hidden, 8) * hidden));
        if (!found.verdict.is_flagged) continue;
        ++flagged;
        outside += found.verdict.kind == VerdictKind::outside_the_list;
    }
    INFO(flagged << " flagged, " << outside << " outside");
    CHECK(flagged >= 0.85 * tables);
    CHECK(outside >= 0.8 * flagged);
}

TEST_CASE("a wild shot is bad data and no effect", "[verdict]") {
    const toys::LinearTable table;
    int right = 0;
    constexpr int tables = 30;
    for (int i = 0; i < tables; ++i) {
        Eigen::VectorXd y =
            table.draw(static_cast<std::uint64_t>(9000 + i), table.no_shift());
        const Eigen::Index shot = i % 16;
        y.segment(3 * shot, 3) += Eigen::Vector3d(1, -1.2, 0.8);  // about ten sd
        const Verdict verdict = table.diagnose(y).verdict;
        right += verdict.kind == VerdictKind::bad_data &&
                 verdict.suspects.front().shot == static_cast<std::size_t>(shot);
    }
    INFO(right << " of " << tables);
    CHECK(right >= 0.9 * tables);
}

TEST_CASE("two effects at once are found as a pair", "[verdict]") {
    const toys::LinearTable table;
    int right = 0, partly = 0;
    constexpr int tables = 20;
    for (int i = 0; i < tables; ++i) {
        const Eigen::VectorXd shift =
            table.amplitude_of(table.effects.col(0), 10) * table.effects.col(0) +
            table.amplitude_of(table.effects.col(5), 10) * table.effects.col(5);
        const ModeDiagnosis found =
            table.diagnose(table.draw(static_cast<std::uint64_t>(400 + i), shift));
        partly += names(found.verdict, 0) && names(found.verdict, 5);
        right += found.verdict.kind == VerdictKind::effect &&
                 found.verdict.effects.size() == 2 && names(found.verdict, 0) &&
                 names(found.verdict, 5);
    }
    INFO(right << " right, " << partly << " with both, of " << tables);
    CHECK(partly >= 0.9 * tables);
    CHECK(right >= 0.7 * tables);
}

TEST_CASE("a second effect is not named where it adds little", "[verdict]") {
    const toys::LinearTable table;
    const Eigen::VectorXd g = table.effects.col(0);
    ModeDiagnosis mode = table.diagnose(table.draw(7, table.amplitude_of(g, 9) * g));
    const double alone = mode.candidates[0].evidence->log_gain;
    REQUIRE(mode.candidates[0].has_physical_sign);
    const auto enough = [&](std::vector<PairRecord> pairs) {
        mode.pairs = std::move(pairs);
        return enough_alone(mode, explaining_pairs(mode));
    };
    // All pairs share one that does almost as much alone.
    CHECK(enough({{{0, 5}, alone + 2, true}, {{2, 0}, alone + 1, true}}) ==
          std::vector<std::size_t>{0});
    // The partners do much, or none is shared, or there is one pair only.
    CHECK(enough({{{0, 5}, alone + 7, true}, {{2, 0}, alone + 6, true}}).empty());
    CHECK(enough({{{0, 5}, alone + 2, true}, {{2, 4}, alone + 1, true}}).empty());
    CHECK(enough({{{0, 5}, alone + 2, true}}).empty());
}

TEST_CASE("nothing is named that the evidence does not tell from nothing", "[verdict]") {
    const toys::LinearTable table;
    int named = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        // Two weak effects: some of these tables are flagged, few have much evidence.
        const Eigen::VectorXd shift =
            table.amplitude_of(table.effects.col(0), 2.5) * table.effects.col(0) +
            table.amplitude_of(table.effects.col(5), 2.5) * table.effects.col(5);
        const ModeDiagnosis found = table.diagnose(table.draw(60000 + i, shift));
        const VerdictKind kind = found.verdict.kind;
        if (!found.verdict.is_flagged ||
            (kind != VerdictKind::effect && kind != VerdictKind::one_of))
            continue;
        ++named;
        double best = 0;
        for (const std::size_t k : found.verdict.effects)
            best = std::max(best, found.candidates[k].evidence->log_gain);
        for (const PairRecord& pair : found.pairs)
            if (pair.explains) best = std::max(best, pair.log_gain);
        CHECK(best >= indistinguishable);
    }
    INFO(named << " named");
    CHECK(named >= 5);
}

TEST_CASE("the verdict over modes or networks is the most cautious one", "[modes]") {
    const toys::LinearTable table;
    const Eigen::VectorXd g = table.effects.col(2);
    const Verdict sound = table.diagnose(table.draw(1001, table.no_shift())).verdict;
    const Verdict missing =
        table.diagnose(table.draw(1001, table.amplitude_of(g, 9) * g)).verdict;
    REQUIRE(missing.is_flagged);
    CHECK(worst_case({missing, missing}).effects == missing.effects);
    // Another mode needs another effect: either.
    Verdict one = missing, other = missing;
    one.kind = other.kind = VerdictKind::effect;
    one.effects = {2};
    other.effects = {4};
    CHECK(worst_case({one, other}).kind == VerdictKind::one_of);
    CHECK(worst_case({one, other}).effects == std::vector<std::size_t>{2, 4});
    // Another mode has no name for it.
    other.kind = VerdictKind::outside_the_list;
    other.effects.clear();
    CHECK(worst_case({one, other}).kind == VerdictKind::not_distinguishable);
    // Another mode explains everything.
    CHECK_FALSE(worst_case({one, sound}).is_flagged);
}

TEST_CASE("a second network must say the same", "[modes]") {
    const toys::LinearTable table;
    const Eigen::VectorXd g = table.effects.col(2);
    const Eigen::VectorXd y = table.draw(1001, table.amplitude_of(g, 9) * g);
    const DiagnosisProblem problem = table.problem(y);
    const Diagnosis alone = diagnose([&](const Eigen::VectorXd&) { return problem; },
                                     RowMatrix::Constant(1, 3, 0.5));
    REQUIRE(alone.verdict.is_flagged);

    Diagnosis agreed = alone;
    ask_second_network(agreed, alone.verdict);
    CHECK(agreed.verdict.effects == alone.verdict.effects);
    CHECK_THAT(verdict_words(problem, agreed), Contains("says the same"));

    Diagnosis doubted = alone;
    ask_second_network(doubted, Verdict{});
    CHECK_FALSE(doubted.verdict.is_flagged);
    CHECK_THAT(verdict_words(problem, doubted),
               Contains("different things") && Contains("no effect supported") &&
                   Contains("depends on where it is asked"));
}

TEST_CASE("one thread and two give the same diagnosis", "[threads]") {
    const toys::LinearTable table;
    const Eigen::VectorXd y = table.draw(21, 4 * table.effects.col(3));
    DiagnosisProblem problem = table.problem(y);
    const auto run = [&](int threads) {
        problem.threads = threads;
        return diagnose([&](const Eigen::VectorXd&) { return problem; },
                        RowMatrix::Constant(2, 3, 0.5));
    };
    const Diagnosis one = run(1), two = run(2);
    CHECK(one.modes.size() == 1);
    for (std::size_t k = 0; k < table.candidates.size(); ++k)
        CHECK(one.modes[0].candidates[k].evidence->log_gain ==
              two.modes[0].candidates[k].evidence->log_gain);
    CHECK(verdict_words(problem, one) == verdict_words(problem, two));
}
