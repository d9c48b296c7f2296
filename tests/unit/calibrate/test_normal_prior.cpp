#include "calibrate/sampling/sample_posterior.hpp"
#include "calibrate/sampling/truncated_normal.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;

TEST_CASE("quantiles of the standard normal", "[prior]") {
    // Tabulated, e.g. Abramowitz and Stegun table 26.5.
    CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(1e-14));
    CHECK(normal_quantile(0.75) == Approx(0.674489750196082).epsilon(1e-14));
    CHECK(normal_quantile(1e-6) == Approx(-4.753424308822899).epsilon(1e-14));
    CHECK(normal_quantile(0.5) == 0);
    CHECK(std::isinf(normal_quantile(0)));
    for (const double z : {-7.5, -3.0, -1.97, -1e-3, 0.4, 2.2, 4.0})
        CHECK(normal_quantile(normal_cdf(z)) == Approx(z).epsilon(1e-9));
}

TEST_CASE("a half-normal prior has its tabulated quantiles", "[prior]") {
    const TruncatedNormal half(0.1, 0, 10);
    CHECK(half.quantile(0.5) == Approx(0.0674489750196).epsilon(1e-10));
    CHECK(half.quantile(0.95) == Approx(0.1959963984540).epsilon(1e-10));
    CHECK(half.quantile(0) == 0);
    CHECK(half.quantile(1) == 10);
}

TEST_CASE("equal steps in probability are equal areas under the bell", "[prior]") {
    struct Range {
        double scale, lower, upper;
    };
    const auto range = GENERATE(Range{0.2, 0, 0.5}, Range{0.5, -1, 0.3}, Range{1, 2.5, 9},
                                Range{1, 5.5, 6}, Range{1, -6, -4.5}, Range{100, -1, 1});
    CAPTURE(range.scale, range.lower, range.upper);
    const TruncatedNormal prior(range.scale, range.lower, range.upper);
    CHECK(prior.quantile(0) == Approx(range.lower).epsilon(1e-7));
    CHECK(prior.quantile(1) == Approx(range.upper).epsilon(1e-7));
    // Areas by the midpoint rule, against the mapping both ways.
    constexpr int steps = 200000;
    const double width = (range.upper - range.lower) / steps;
    const auto density = [&](int i) {
        const double z = (range.lower + (i + 0.5) * width) / range.scale;
        return std::exp(-0.5 * z * z);
    };
    double total = 0, area = 0;
    for (int i = 0; i < steps; ++i) total += density(i);
    for (int i = 0; i < steps; ++i) {
        area += density(i);
        if (i % 20000 != 9999) continue;
        const double value = range.lower + (i + 1) * width, share = area / total;
        CHECK(prior.cdf(value) == Approx(share).margin(1e-8));
        // Nearer to 1 a double holds too few digits of what is left of the tail.
        if (1 - share > 1e-8) CHECK(prior.quantile(share) == Approx(value).epsilon(1e-6));
    }
}

TEST_CASE("a normal prior enters the posterior and the evidence", "[prior]") {
    // One shot measures the parameter itself. Prior N(0, s^2) cut off far away, error sd:
    // Z = N(y; 0, s^2 + sd^2), mean y s^2 / (s^2 + sd^2); for the half normal one both
    // are cut at 0.
    const bool half = GENERATE(false, true);
    CAPTURE(half);
    const double scale = 1.5, sd = 2, y = 1;
    Settings settings;
    settings.parameters = {{"amplitude", half ? 0.0 : -20.0, 20, false, false, scale}};
    settings.fit_sizes = {"final_length_mm"};
    settings.velocity_sd_relative = 0;
    const toys::ClosedForm model(
        [](const Shot&, const Eigen::VectorXd& p) { return Eigen::VectorXd(p); },
        Eigen::MatrixXd::Zero(1, 1));
    const DataSet set = make_data_set(
        {toys::shot("a", "one", 150, {{"final_length_mm", y, sd}})}, settings.fit_sizes);
    const ParameterSpace space(settings.parameters, set.lots);
    const Posterior posterior = sample_posterior(settings, set, space, model, {1});

    const double both = scale * scale + sd * sd;
    const double mean = y * scale * scale / both, spread = scale * sd / std::sqrt(both);
    double log_z = -0.5 * (y * y / both + std::log(2 * std::numbers::pi * both));
    double expected = mean;
    if (half) {
        const double z = mean / spread;
        log_z += std::log(2 * normal_cdf(z));
        expected += spread * std::exp(-0.5 * z * z) /
                    (std::sqrt(2 * std::numbers::pi) * normal_cdf(z));
    }
    CHECK(std::abs(posterior.log_evidence - log_z) < 4 * posterior.log_evidence_sd);
    double sampled = 0;
    for (Eigen::Index i = 0; i < posterior.pool.units.rows(); ++i)
        sampled += posterior.pool.weights(i) * space.value(0, posterior.pool.units(i, 0));
    CHECK(sampled == Approx(expected).margin(0.05));
    CHECK(space.unit(0, space.value(0, 0.3)) == Approx(0.3));
}
