#include "calibrate/likelihood/errors_of_shot.hpp"
#include "calibrate/likelihood/shot_likelihood.hpp"
#include "calibrate/likelihood/spread_levels.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace taylorcal::calibrate;

namespace {

const std::vector<std::string> sizes{"final_length_mm", "impact_diameter_mm"};

Datum two_sizes() {
    const Shot shot = toys::shot(
        "a", "one", 200, {{"final_length_mm", 30, 0.3}, {"impact_diameter_mm", 10, 0.2}});
    return make_data_set({shot}, sizes).data.front();
}

toys::ClosedForm model() {
    Eigen::MatrixXd network(2, 2);
    network << 0.04, 0.01, 0.01, 0.09;
    // df/dv = (-0.05, 0.02) mm/(m/s) at every velocity.
    return {[](const Shot& shot, const Eigen::VectorXd& p) {
                Eigen::VectorXd f(2);
                f << 40 * p(0) - 0.05 * shot.velocity_m_s, 6 + 0.02 * shot.velocity_m_s;
                return f;
            },
            network};
}

}  // namespace

TEST_CASE("the error covariance is the sum of its four parts", "[covariance]") {
    Settings settings;
    settings.velocity_sd_relative = 0.01;
    const Eigen::VectorXd parameters = Eigen::VectorXd::Ones(1);
    Datum datum = two_sizes();

    // By hand: sd_v = 2 m/s moves the sizes by (-0.1, 0.04) mm together.
    Eigen::MatrixXd expected(2, 2);
    expected << 0.09 + 0.01 + 0.04, -0.004 + 0.01, -0.004 + 0.01, 0.04 + 0.0016 + 0.09;
    const Eigen::MatrixXd fixed = fixed_covariance(settings, model(), datum, parameters);
    CHECK((fixed - expected).cwiseAbs().maxCoeff() < 1e-10);

    // tau = 0.02 adds (0.6 mm)^2 and (0.2 mm)^2.
    expected(0, 0) += 0.36;
    expected(1, 1) += 0.04;
    CHECK((with_spread(fixed, datum, 0.02) - expected).cwiseAbs().maxCoeff() < 1e-10);

    SECTION("the table's own velocity error comes first") {
        datum.shot.velocity_sd_m_s = 4;
        const Eigen::MatrixXd wider =
            fixed_covariance(settings, model(), datum, parameters);
        CHECK(wider(0, 1) - fixed(0, 1) == Approx(-0.05 * 0.02 * (16 - 4)));
    }
    SECTION("the paper's form has no errors of its own") {
        settings.likelihood = LikelihoodForm::paper;
        CHECK(fixed_covariance(settings, model(), datum, parameters).norm() == 0);
    }
}

TEST_CASE("the velocity slope stays inside the predictor's range", "[covariance]") {
    Datum datum = two_sizes();
    datum.shot.velocity_m_s = 1000;  // the upper end
    const Eigen::VectorXd slope =
        velocity_slope(model(), datum, Eigen::VectorXd::Ones(1));
    CHECK(slope(0) == Approx(-0.05));
    CHECK(slope(1) == Approx(0.02));
}

TEST_CASE("ln L is the normal density with its determinant", "[covariance]") {
    const Datum datum = two_sizes();
    Eigen::MatrixXd fixed(2, 2);
    fixed << 0.25, 0.1, 0.1, 0.16;
    const SpreadLevels levels{"tau", {0, 0.01}, {0, 0.005, 0.015}, {-0.7, -0.7}};
    const ShotLikelihood likelihood(datum, fixed, levels);
    Eigen::VectorXd predicted(2);
    predicted << 29.4, 10.3;
    std::vector<double> found(2, 0.0);
    likelihood.add(predicted, found.data());
    for (std::size_t g = 0; g < 2; ++g) {
        const double t = levels.values[g];
        const double a = 0.25 + 900 * t * t, b = 0.1, c = 0.16 + 100 * t * t;
        const double det = a * c - b * b, x = 0.6, y = -0.3;
        const double chi2 = (c * x * x - 2 * b * x * y + a * y * y) / det;
        const double expected =
            -0.5 * (chi2 + std::log(det) + 2 * std::log(2 * std::numbers::pi));
        CHECK(found[g] == Approx(expected).epsilon(1e-12));
        CHECK(likelihood.whitened(predicted, g).squaredNorm() ==
              Approx(chi2).epsilon(1e-12));
    }
}

TEST_CASE("the paper's sigma is averaged in closed form", "[covariance]") {
    // Integral over ln sigma of prod N(d_i; 0, sigma) = Gamma(n/2) / (2 (pi S)^(n/2)),
    // S = sum d_i^2, over the width ln(1000) of the prior.
    const SpreadLevels levels = relative_sigma_levels();
    const double deviations[] = {0.03, -0.05, 0.02, 0.04, -0.01, 0.06};
    double sum = 0, squares = 0;
    for (const double d : deviations) squares += d * d;
    for (std::size_t g = 0; g < levels.values.size(); ++g) {
        double log_l = levels.log_mass[g];
        for (const double d : deviations) {
            const Datum datum =
                make_data_set({toys::shot("a", "one", 200, {{"final_length_mm", 1, 1}})},
                              sizes)
                    .data.front();
            const SpreadLevels one{"", {levels.values[g]}, {0, 0}, {0}};
            double single = 0;
            ShotLikelihood(datum, Eigen::MatrixXd::Zero(1, 1), one)
                .add(Eigen::VectorXd::Constant(2, 1 - d), &single);
            log_l += single;
        }
        sum += std::exp(log_l);
    }
    const double width = std::log(levels.edges.back() / levels.edges.front());
    const double exact =
        std::tgamma(3.0) / (2 * std::pow(std::numbers::pi * squares, 3)) / width;
    CHECK(sum == Approx(exact).epsilon(1e-3));
}

TEST_CASE("prior masses of the spread add up to one", "[covariance]") {
    const SpreadLevels levels =
        unexplained_spread_levels({0.02, {0, 0.005, 0.01, 0.02, 0.04, 0.08}});
    double total = 0;
    for (const double mass : levels.log_mass) total += std::exp(mass);
    CHECK(total == Approx(1));
    // P(tau < 0.0025) = erf(0.125 / sqrt 2)
    CHECK(std::exp(levels.log_mass[0]) == Approx(std::erf(0.125 / std::sqrt(2.0))));
}
