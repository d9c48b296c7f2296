#include "calibrate/diagnosis/evidence.hpp"
#include "tests/unit/diagnosis/linear_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

/// Sizes that rise exponentially with the first parameter.
struct CurvedTable final : toys::LinearTable {
    static double h(double u) { return std::expm1(4 * (u - 0.5)) / 4; }
    RowMatrix predict(const RowMatrix& units) const override {
        RowMatrix bent = units;
        bent.col(0) = units.col(0).unaryExpr([](double u) { return 0.5 + h(u); });
        return toys::LinearTable::predict(bent);
    }
};

/// A table whose second effect is no straight line in its amplitude.
struct BentTable final : toys::LinearTable {
    std::function<double(double)> shift_of;
    RunRange runs{0, 10, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Ones(3)};

    BentTable() {
        candidates[1].highest = 10;
        candidates[1].prior.scale = 4;
    }
    double signature_sd = 0;  ///< of a shift's share, a unit of amplitude

    RunRange run_range(std::size_t) const override { return runs; }
    Eigen::MatrixXd shift_covariance(std::size_t k) const override {
        if (signature_sd == 0) return {};
        const auto g = effects.col(static_cast<Eigen::Index>(k));
        return signature_sd * signature_sd * g * g.transpose();
    }
    RowMatrix shift(std::size_t k, const RowMatrix& units,
                    const Eigen::VectorXd& amplitudes) const override {
        return toys::LinearTable::shift(k, units, amplitudes.unaryExpr(shift_of));
    }
    /// Of data without noise, a shift of 1 standing out by `sigma`.
    EffectEvidence evidence_of(double amplitude, double sigma) {
        effects.col(1) *= amplitude_of(effects.col(1), sigma);
        const DiagnosisProblem problem =
            this->problem(base + shift_of(amplitude) * effects.col(1));
        const Whitening whiten(problem.covariance);
        const Refit without = refit(problem, whiten, {},
                                    Eigen::VectorXd::Constant(3, 0.5), Eigen::VectorXd());
        return effect_evidence(problem, whiten, without, 1);
    }
    EffectEvidence evidence_without_limits(double amplitude, double sigma) {
        runs = {0, 10, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Ones(3)};
        return evidence_of(amplitude, sigma);
    }
};

/// The lowest and the highest amplitude up to 10 whose chi^2 is at most 3.84.
template <class Chi2>
std::pair<double, double> interval_of(Chi2 chi2) {
    constexpr int steps = 20000;
    double lower = 10, upper = 0;
    for (int i = 0; i <= steps; ++i) {
        const double amplitude = 10.0 * i / steps;
        if (chi2(amplitude) > 3.841) continue;
        lower = std::min(lower, amplitude);
        upper = amplitude;
    }
    return {lower, upper};
}

}  // namespace

TEST_CASE("the amplitude's interval is that of the data alone", "[evidence]") {
    toys::LinearTable table;
    // Its prior would halve the amplitude.
    const double sd = 1 / table.amplitude_of(table.effects.col(1), 1);
    for (Candidate& c : table.candidates)
        c.prior = {AmplitudePrior::Kind::half_normal, 1 / sd};
    const ModeDiagnosis found = table.diagnose(table.draw(
        4, table.amplitude_of(table.effects.col(1), 8) * table.effects.col(1)));
    const EffectEvidence& e = *found.candidates[1].evidence;
    const double a = found.candidates[1].screening.projected.norm();
    const double m = found.candidates[1].screening.score / a;
    CHECK(e.mean == Approx(m).epsilon(0.01));
    CHECK(e.sd == Approx(1 / a).epsilon(0.02));
    CHECK(e.interval.lower95 == Approx(m - 1.96 / a).epsilon(0.02));
    CHECK(e.interval.upper95 == Approx(m + 1.96 / a).epsilon(0.02));
}

TEST_CASE("the amplitude's interval follows the parameters along a curved ridge",
          "[evidence]") {
    // The first parameter makes up for nearly all of the effect: chi^2 at an amplitude k,
    // refitted, is (k - 5)^2 a^2, and the share of the prior there is 1/h'(u).
    constexpr double per_amplitude = 0.1, true_amplitude = 5, true_unit = 0.65;
    CurvedTable table;
    table.effects.col(1) *= table.amplitude_of(table.effects.col(1), 1.0);  // a = 1
    table.effects.col(1) -= per_amplitude * table.slope.col(0);
    RowMatrix truth(1, 3);
    truth << true_unit, 0.5, 0.5;
    const Eigen::VectorXd measured =
        table.predict(truth).row(0).transpose() + true_amplitude * table.effects.col(1);
    const DiagnosisProblem problem = table.problem(measured);
    const Whitening whiten(problem.covariance);
    const Refit base =
        refit(problem, whiten, {}, Eigen::VectorXd::Constant(3, 0.5), Eigen::VectorXd());
    const EffectEvidence e = effect_evidence(problem, whiten, base, 1);
    std::vector<double> amplitudes, shares;
    double whole = 0;
    for (double k = 0; k <= 12; k += 0.01) {
        const double slope =
            1 + 4 * (CurvedTable::h(true_unit) + per_amplitude * (k - true_amplitude));
        if (slope <= std::exp(-2) || slope >= std::exp(2)) continue;
        whole += std::exp(-0.5 * std::pow(k - true_amplitude, 2)) / slope;
        amplitudes.push_back(k);
        shares.push_back(whole);
    }
    const auto quantile = [&](double share) {
        const auto at = std::ranges::lower_bound(shares, share * whole);
        return amplitudes[static_cast<std::size_t>(at - shares.begin())];
    };
    CHECK(e.interval.lower95 == Approx(quantile(0.025)).margin(0.1));
    CHECK(e.interval.upper95 == Approx(quantile(0.975)).margin(0.1));
}

TEST_CASE("the fit moves to a better place far from where it starts", "[evidence]") {
    // Small amplitudes shift the data the wrong way, so that the nearest optimum is none.
    BentTable table;
    table.shift_of = [](double k) { return k * (k - 2) / 15; };
    constexpr double sigma = 8, true_amplitude = 5;
    const EffectEvidence e = table.evidence_of(true_amplitude, sigma);
    CHECK(e.fit.amplitudes(0) == Approx(true_amplitude).epsilon(1e-3));
    CHECK(e.fit.chi2() == Approx(0).margin(1e-3));
    CHECK(e.mean == Approx(true_amplitude).epsilon(0.01));
    const auto chi2 = [&](double k) {
        return std::pow(sigma * (table.shift_of(k) - table.shift_of(true_amplitude)), 2);
    };
    const auto [lower, upper] = interval_of(chi2);
    CHECK(e.interval.lower95 == Approx(lower).epsilon(0.01));
    CHECK(e.interval.upper95 == Approx(upper).epsilon(0.01));
    // Its evidence is that of the whole likelihood, by the trapezium rule.
    double integral = 0;
    const AmplitudePrior& prior = table.candidates[1].prior;
    for (double k = 0; k <= 10; k += 1e-3)
        integral += 1e-3 * std::exp(prior.log_density(k) - 0.5 * chi2(k));
    CHECK(e.log_gain == Approx(std::log(integral) + 0.5 * chi2(0)).margin(0.03));
}

TEST_CASE("of two places that fit alike the interval covers both", "[evidence]") {
    BentTable table;
    table.shift_of = [](double k) { return k * (10 - k) / 16; };
    const EffectEvidence e = table.evidence_of(2, 8);  // as good as 8
    const auto [lower, upper] = interval_of([&](double k) {
        return std::pow(8 * (table.shift_of(k) - table.shift_of(2)), 2);
    });
    REQUIRE(lower < 2);
    REQUIRE(upper > 8);
    CHECK(e.interval.lower95 == Approx(lower).margin(0.05));
    CHECK(e.interval.upper95 == Approx(upper).margin(0.05));
}

TEST_CASE("a far place that its signature's errors spoil is no fit, but not excluded",
          "[evidence]") {
    // 0.84 of the shift at an amplitude of 1.5, all of it at 6.5.
    BentTable table;
    table.shift_of = [](double k) {
        return -std::expm1(-4 * k) * (0.84 * std::exp(-std::pow(k - 1.5, 2)) +
                                      std::exp(-std::pow((k - 6.5) / 2, 2)));
    };
    const EffectEvidence exact = table.evidence_of(6.5, 8);
    CHECK(exact.fit.amplitudes(0) == Approx(6.5).margin(0.3));
    CHECK(exact.interval.lower95 < 3);
    CHECK(exact.interval.upper95 > 6.5);
    // The signature's errors grow with the amplitude and leave little of the gain far
    // off: the fit stays near. But no error speaks against the far place, which is true.
    table.signature_sd = 0.03;
    const EffectEvidence e = table.evidence_of(6.5, 8);
    CHECK(e.fit.amplitudes(0) == Approx(1.5).margin(0.1));
    CHECK(e.mean < 3);
    CHECK(e.interval.lower95 > 0.5);
    CHECK(e.interval.upper95 > 6.5);
}

TEST_CASE("what is known badly excludes little", "[evidence]") {
    // 1.2 of the shift of a unit; with an error of 30 % of the shift, from 0.5 to
    // beyond 2.
    BentTable table;
    table.shift_of = [](double k) { return k; };
    const AmplitudeInterval exact = table.evidence_of(1.2, 10).interval;
    CHECK(exact.lower95 == Approx(1.2 - 0.196).epsilon(0.01));
    CHECK(exact.upper95 == Approx(1.2 + 0.196).epsilon(0.01));
    table.signature_sd = 0.3;
    const AmplitudeInterval rough = table.evidence_of(1.2, 10).interval;
    // (k - 1.2)^2 = 3.84 (0.1^2 + 0.3^2 k^2)
    CHECK(rough.lower95 == Approx(0.729).epsilon(0.02));
    CHECK(rough.upper95 == Approx(2.939).epsilon(0.02));
}

TEST_CASE("where nothing but the best amplitude is allowed the search ends",
          "[evidence]") {
    // The least amplitude shifts the data by five: its interval is a point.
    BentTable table;
    int shifts = 0;
    table.shift_of = [&](double k) { return ++shifts, k > 0 ? k + 5 : 0; };
    const AmplitudeInterval interval = table.evidence_of(0, 8).interval;
    CHECK(interval.lower95 == 0);
    CHECK(interval.upper95 < 1e-6);
    CHECK(shifts < 8000);
}

TEST_CASE("nothing is found where no paired run is", "[evidence]") {
    BentTable table;
    table.shift_of = [](double k) { return k * (k - 2) / 15; };
    table.runs.highest = 1.5;  // the better place lies beyond
    const EffectEvidence e = table.evidence_of(5, 8);
    CHECK(e.fit.amplitudes(0) == Approx(0).margin(1e-6));
    CHECK(e.interval.upper95 <= 1.5);
    CHECK_FALSE(e.is_at_end_of_runs);
    CHECK(e.log_gain < 0);
    // A fit that would go on is held, and says so.
    table.shift_of = [](double k) { return k / 5; };
    const EffectEvidence held = table.evidence_of(5, 8);
    CHECK(held.fit.amplitudes(0) == Approx(1.5));
    CHECK(held.is_at_end_of_runs);
    // Parameters of the fit stay within those of the runs too; without the effect they
    // need not.
    table.runs.highest = 10;
    table.runs.lower(0) = 0.55;
    const EffectEvidence shifted = table.evidence_of(5, 8);
    CHECK(shifted.fit.unit(0) == Approx(0.55));
    CHECK(shifted.is_at_end_of_runs);
    CHECK(shifted.log_gain < table.evidence_without_limits(5, 8).log_gain - 10);
}
