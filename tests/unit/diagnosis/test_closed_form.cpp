#include "calibrate/diagnosis/extra_error.hpp"
#include "calibrate/diagnosis/leave_out.hpp"
#include "calibrate/diagnosis/smooth_fit.hpp"
#include "calibrate/diagnosis/tail_probability.hpp"
#include "tests/unit/diagnosis/linear_table.hpp"

#include <algorithm>
#include <cmath>
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
