#include "calibrate/diagnosis/extra_error.hpp"
#include "calibrate/diagnosis/leave_out.hpp"
#include "calibrate/diagnosis/smooth_fit.hpp"
#include "calibrate/diagnosis/tail_probability.hpp"
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

/// ln N(x; 0, C).
double log_density(const Eigen::VectorXd& x, const Eigen::MatrixXd& covariance) {
    return -0.5 *
           (x.dot(covariance.ldlt().solve(x)) + std::log(covariance.determinant()) +
            static_cast<double>(x.size()) * std::log(2 * M_PI));
}

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

/// The middle 95 % of exp(-chi2/2) from 0 to `highest`.
template <class Chi2>
std::pair<double, double> interval_of(Chi2 chi2, double highest) {
    std::vector<double> shares;
    double whole = 0;
    constexpr int steps = 20000;
    for (int i = 0; i <= steps; ++i)
        shares.push_back(whole += std::exp(-0.5 * chi2(highest * i / steps)));
    const auto at = [&](double share) {
        const auto found = std::ranges::lower_bound(shares, share * whole);
        return highest * static_cast<double>(found - shares.begin()) / steps;
    };
    return {at(0.025), at(0.975)};
}

}  // namespace

TEST_CASE("tails of normal and chi^2 distributions have their known values", "[tail]") {
    CHECK(normal_tail(1.959963984540054) == Approx(0.025).epsilon(1e-12));
    CHECK(normal_tail(10) == Approx(7.619853024160527e-24).epsilon(1e-9));
    CHECK(normal_quantile_of_tail(0.1) == Approx(1.2815515655446).epsilon(1e-10));
    CHECK(chi2_tail(3.841458820694124, 1) == Approx(0.05).epsilon(1e-10));
    // Even degrees of freedom have a finite sum.
    CHECK(chi2_tail(7, 4) == Approx(std::exp(-3.5) * (1 + 3.5)).epsilon(1e-12));
    CHECK(chi2_tail(200, 4) == Approx(std::exp(-100) * 101).epsilon(1e-10));
    CHECK(chi2_tail(0, 3) == 1);
    // Tables of F, and Student's t with one degree of freedom, which is Cauchy's.
    CHECK(fisher_tail(3.325834, 5, 10) == Approx(0.05).epsilon(1e-5));
    CHECK(fisher_tail(100, 1, 1) == Approx(1 - 2 / M_PI * std::atan(10.0)).epsilon(1e-9));
    CHECK(fisher_tail(2, 4, 1e9) == Approx(chi2_tail(8, 4)).epsilon(1e-6));
    CHECK(fisher_tail(2, 4, INFINITY) == chi2_tail(8, 4));
}

TEST_CASE("scores, chi^2 and amplitudes are those of the normal equations",
          "[screening]") {
    const toys::LinearTable table;
    const Eigen::VectorXd y = table.draw(3, 5 * table.effects.col(2));
    const ModeDiagnosis found = table.diagnose(y);
    const Eigen::VectorXd r = table.project(table.white(y - table.base));
    CHECK(found.adequacy.chi2 == Approx(r.squaredNorm()).epsilon(1e-6));
    CHECK(found.adequacy.parameters == 3);
    for (std::size_t k = 0; k < table.candidates.size(); ++k) {
        const Eigen::VectorXd g =
            table.white(table.effects.col(static_cast<Eigen::Index>(k)));
        const Eigen::VectorXd pg = table.project(g);
        const Screening& s = found.candidates[k].screening;
        CHECK(s.identifiability == Approx(pg.norm() / g.norm()).epsilon(1e-6));
        CHECK(s.score == Approx(pg.dot(r) / pg.norm()).margin(1e-4));
        CHECK(s.amplitude == Approx(pg.dot(r) / pg.squaredNorm()).margin(1e-4));
    }
}

TEST_CASE("the evidence of an effect is the conjugate one", "[evidence]") {
    toys::LinearTable table;
    const auto kind =
        GENERATE(AmplitudePrior::Kind::normal, AmplitudePrior::Kind::half_normal,
                 AmplitudePrior::Kind::uniform);
    for (Candidate& c : table.candidates) {
        c.prior = {kind, 3};
        if (kind != AmplitudePrior::Kind::half_normal) c.lowest = -100;
    }
    const ModeDiagnosis found = table.diagnose(table.draw(4, 1.5 * table.effects.col(1)));
    for (const CandidateRecord& record : found.candidates) {
        REQUIRE(record.evidence);
        const double a = record.screening.projected.norm(), z = record.screening.score;
        const auto exact = [&](double scale) {
            // The likelihood of the amplitude is N(z/a, 1/a^2), its peak exp(z^2/2).
            const double s2 = scale * scale, v = 1 / (1 / s2 + a * a), m = v * a * z;
            const auto within = [&](double low, double high) {
                return normal_tail((low - z / a) * a) - normal_tail((high - z / a) * a);
            };
            switch (kind) {
                case AmplitudePrior::Kind::normal:
                    return 0.5 * (m * m / v + std::log(v / s2));
                case AmplitudePrior::Kind::half_normal:
                    return 0.5 * (m * m / v + std::log(v / s2)) +
                           std::log(2 * normal_tail(-m / std::sqrt(v)));
                default:
                    return 0.5 * z * z + std::log(std::sqrt(2 * M_PI) / a) +
                           std::log(within(-scale, scale) / (2 * scale));
            }
        };
        CHECK(record.evidence->log_gain == Approx(exact(3)).margin(0.02));
        CHECK(record.evidence->log_gain_half_width == Approx(exact(1.5)).margin(0.02));
        CHECK(record.evidence->log_gain_double_width == Approx(exact(6)).margin(0.02));
    }
}

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
    CHECK(e.lower95 == Approx(m - 1.96 / a).epsilon(0.02));
    CHECK(e.upper95 == Approx(m + 1.96 / a).epsilon(0.02));
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
    CHECK(e.lower95 == Approx(quantile(0.025)).margin(0.1));
    CHECK(e.upper95 == Approx(quantile(0.975)).margin(0.1));
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
    const auto [lower, upper] = interval_of(chi2, 10);
    CHECK(e.lower95 == Approx(lower).epsilon(0.01));
    CHECK(e.upper95 == Approx(upper).epsilon(0.01));
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
    const auto [lower, upper] = interval_of(
        [&](double k) {
            return std::pow(8 * (table.shift_of(k) - table.shift_of(2)), 2);
        },
        10);
    REQUIRE(lower < 2);
    REQUIRE(upper > 8);
    CHECK(e.lower95 == Approx(lower).margin(0.05));
    CHECK(e.upper95 == Approx(upper).margin(0.05));
}

TEST_CASE("a far place that only its signature's errors spoil is left out",
          "[evidence]") {
    // 0.84 of the shift at an amplitude of 1.4, all of it at 6.
    BentTable table;
    table.shift_of = [](double k) {
        return k * (1.4066666666666667 + k * (-0.6866666666666667 + 0.08 * k));
    };
    const EffectEvidence exact = table.evidence_of(6, 8);
    CHECK(exact.fit.amplitudes(0) == Approx(6).epsilon(1e-3));
    CHECK(exact.lower95 < 3);
    CHECK(exact.upper95 > 5.9);
    // Errors of a fifth of an amplitude's shift leave little of the gain at 6.
    table.signature_sd = 0.03;
    const EffectEvidence e = table.evidence_of(6, 8);
    CHECK(e.fit.amplitudes(0) == Approx(1.36).margin(0.05));
    CHECK(e.lower95 > 0.5);
    CHECK(e.upper95 < 3);
}

TEST_CASE("nothing is found where no paired run is", "[evidence]") {
    BentTable table;
    table.shift_of = [](double k) { return k * (k - 2) / 15; };
    table.runs.highest = 1.5;  // the better place lies beyond
    const EffectEvidence e = table.evidence_of(5, 8);
    CHECK(e.fit.amplitudes(0) == Approx(0).margin(1e-6));
    CHECK(e.upper95 <= 1.5);
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

TEST_CASE("a further part of the errors gains what the joint Gaussian says",
          "[evidence]") {
    const toys::LinearTable table;
    const Eigen::VectorXd r =
        table.white(table.draw(6, table.effects.col(3)) - table.base);
    const Eigen::MatrixXd patterns = table.white(table.effects.leftCols(4));
    // Without the parameters' directions: an orthonormal basis of what is left.
    const Eigen::MatrixXd j = table.white(table.slope);
    const Eigen::MatrixXd q = j.householderQr().householderQ();
    const Eigen::MatrixXd left = q.rightCols(q.cols() - j.cols());
    const auto n = left.cols();
    const auto gain = [&](double s) {
        const Eigen::MatrixXd b = left.transpose() * patterns;
        const Eigen::MatrixXd whole =
            Eigen::MatrixXd::Identity(n, n) + s * s * b * b.transpose();
        return log_density(left.transpose() * r, whole) -
               log_density(left.transpose() * r, Eigen::MatrixXd::Identity(n, n));
    };
    const Eigen::MatrixXd columns = table.project(patterns);
    const Eigen::VectorXd rest = table.project(r);
    const std::vector<double> one{0.7}, two{0.7, 3.0};
    CHECK(gain_of_extra_error(columns, rest, one) == Approx(gain(0.7)).epsilon(1e-9));
    CHECK(
        gain_of_extra_error(columns, rest, two) ==
        Approx(std::log((std::exp(gain(0.7)) + std::exp(gain(3.0))) / 2)).epsilon(1e-9));
}

TEST_CASE("the evidence of a pair is the conjugate one", "[evidence]") {
    toys::LinearTable table;
    const double amplitude = table.amplitude_of(table.effects.col(0), 12);
    // Also where data and prior disagree by eight of its standard deviations, and where
    // the prior is far narrower than what the data say.
    const double scale = amplitude * GENERATE(1.0, 0.125, 0.001);
    for (Candidate& c : table.candidates) {
        c.prior = {AmplitudePrior::Kind::normal, scale};
        c.lowest = -100;
    }
    const Eigen::VectorXd shift =
        amplitude * table.effects.col(0) +
        table.amplitude_of(table.effects.col(5), 10) * table.effects.col(5);
    const Eigen::VectorXd y = table.draw(5, shift);
    const ModeDiagnosis found = table.diagnose(y);
    REQUIRE(found.pairs.size() >= 3);
    const Eigen::VectorXd r = table.project(table.white(y - table.base));
    for (const PairRecord& pair : found.pairs) {
        Eigen::MatrixXd both(y.size(), 2);
        for (Eigen::Index e = 0; e < 2; ++e)
            both.col(e) = table.effects.col(
                static_cast<Eigen::Index>(pair.effects[static_cast<std::size_t>(e)]));
        const std::vector<double> scales{scale};
        CHECK(pair.log_gain ==
              Approx(gain_of_extra_error(table.project(table.white(both)), r, scales))
                  .margin(0.05));
    }
}

TEST_CASE("leaving a shape out predicts it as the joint Gaussian says", "[leave_out]") {
    const toys::LinearTable table;
    const Eigen::VectorXd y = table.draw(8, table.no_shift());
    const DiagnosisProblem problem = table.problem(y);
    const Whitening whiten(table.covariance);
    const Refit fit = refit(problem, whiten, {2}, Eigen::VectorXd::Constant(3, 0.5),
                            Eigen::VectorXd::Ones(1));
    const double score =
        leave_out_score(problem, fit, table.covariance, groups_to_leave_out(problem));
    // y ~ N(base, C + A A^T / 12 + g g^T), and p(y_a | y_b) = p(y) / p(y_b).
    const Eigen::MatrixXd whole = table.covariance +
                                  table.slope * table.slope.transpose() / 12 +
                                  table.effects.col(2) * table.effects.col(2).transpose();
    const Eigen::VectorXd x = y - table.base;
    const Eigen::Index half = x.size() / 2;
    const double exact = 2 * log_density(x, whole) -
                         log_density(x.head(half), whole.topLeftCorner(half, half)) -
                         log_density(x.tail(half), whole.bottomRightCorner(half, half));
    CHECK(score == Approx(exact).margin(0.01));
}

TEST_CASE("the maximum of correlated statistics has its family-wise level", "[maximum]") {
    const NormalTable numbers(3, 8);
    // Independent: P(max |z| > c) = 1 - (1 - p)^4. Identical: p.
    const MaximumTest independent(Eigen::MatrixXd::Identity(6, 4),
                                  std::vector<Side>(4, Side::both), numbers);
    const MaximumTest same(Eigen::MatrixXd::Ones(6, 4), std::vector<Side>(4, Side::both),
                           numbers);
    const MaximumTest one_sided(Eigen::MatrixXd::Ones(6, 1), {Side::positive}, numbers);
    const double p = 2 * normal_tail(2);
    CHECK(independent.probability(2) == Approx(1 - std::pow(1 - p, 4)).epsilon(0.04));
    CHECK(same.probability(2) == Approx(p).epsilon(0.08));
    CHECK(one_sided.probability(2) == Approx(p / 2).epsilon(0.1));
    CHECK(one_sided.strength(0, -3) == -3);
    // Far out the bound takes over from counting.
    CHECK(independent.probability(7) == Approx(8 * normal_tail(7)).epsilon(1e-9));
}

TEST_CASE("a variance known from few runs makes a wild number less sure", "[bad_data]") {
    const toys::LinearTable table;
    const DiagnosisProblem exact = table.problem(table.draw(5, table.no_shift()));
    DiagnosisProblem estimated = exact;
    constexpr double freedom = 4;
    estimated.freedom = Eigen::VectorXd::Constant(exact.measured.size(), freedom);
    const Whitening whiten(exact.covariance);
    const Refit fit =
        refit(exact, whiten, {}, Eigen::VectorXd::Constant(3, 0.5), Eigen::VectorXd());
    const std::vector<Suspect> sure = suspect_data(exact, whiten, fit),
                               less = suspect_data(estimated, whiten, fit);
    REQUIRE(sure.size() == less.size());
    const auto all = static_cast<double>(sure.size());
    for (std::size_t i = 0; i < sure.size(); ++i)
        if (!sure[i].size.empty())
            CHECK(less[i].p ==
                  Approx(
                      std::min(1.0, all * fisher_tail(sure[i].z * sure[i].z, 1, freedom)))
                      .epsilon(1e-9));
}

TEST_CASE("a fit knows its noise as well as points exceed terms", "[smooth_fit]") {
    Eigen::MatrixXd scaled(6, 1), targets(6, 1);
    scaled << -1, -0.6, -0.2, 0.2, 0.6, 1;
    targets << -2.01, -1.19, -0.41, 0.4, 1.21, 1.99;  // a slope of 2 and little else
    const SmoothFit fit = fit_smoothly(scaled, Eigen::VectorXd(), targets);
    CHECK(fit.terms.velocity_order == 1);
    CHECK(fit.freedom == 4);
}

TEST_CASE("a shot's deviation is studentised against the others", "[bad_data]") {
    const toys::LinearTable table;
    const Eigen::VectorXd y = table.draw(5, table.no_shift());
    const ModeDiagnosis found = table.diagnose(y);
    // Independent road: fit the others by generalised least squares and predict the shot.
    const Eigen::Index n = y.size(), at = 12;
    std::vector<Eigen::Index> shot{at, at + 1, at + 2}, others;
    for (Eigen::Index i = 0; i < n; ++i)
        if (i < at || i > at + 2) others.push_back(i);
    const Eigen::MatrixXd c_oo = table.covariance(others, others);
    const Eigen::MatrixXd a_o = table.slope(others, Eigen::all);
    const Eigen::MatrixXd information = a_o.transpose() * c_oo.inverse() * a_o;
    const Eigen::VectorXd x = y - table.base;
    const Eigen::VectorXd fit =
        information.inverse() * a_o.transpose() * c_oo.inverse() * x(others);
    const Eigen::MatrixXd a_s = table.slope(shot, Eigen::all);
    const Eigen::MatrixXd spread = Eigen::MatrixXd(table.covariance(shot, shot)) +
                                   a_s * information.inverse() * a_s.transpose();
    const Eigen::VectorXd gap = x(shot) - a_s * fit;
    const double chi2 = gap.dot(spread.inverse() * gap);
    for (const Suspect& suspect : found.suspects)
        if (suspect.shot == 4 && suspect.size.empty())
            CHECK(suspect.z ==
                  Approx(std::max(0.0, normal_quantile_of_tail(chi2_tail(chi2, 3))))
                      .margin(1e-3));
}
