#include "calibrate/sampling/sample_posterior.hpp"
#include "common/random.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/core.h>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

/// Shots of a straight line with measuring errors of 0.3 % and `extra` relative spread.
Posterior calibrate_line(double extra, Settings& settings) {
    settings.parameters = {{"length", 20, 60, false, false}};
    settings.fit_sizes = {"final_length_mm"};
    settings.velocity_sd_relative = 0;
    settings.draws = 4000;
    const toys::ClosedForm model(
        [](const Shot& shot, const Eigen::VectorXd& p) {
            return Eigen::VectorXd::Constant(1, p(0) - 0.05 * shot.velocity_m_s);
        },
        Eigen::MatrixXd::Zero(1, 1));
    const RandomStream noise(11, 1);
    std::vector<Shot> shots;
    for (std::uint64_t i = 0; i < 60; ++i) {
        const double velocity = 100 + 2 * static_cast<double>(i);
        const double exact = 40 - 0.05 * velocity;
        const double measured =
            exact * (1 + 0.003 * noise.normal(2 * i) + extra * noise.normal(2 * i + 1));
        shots.push_back(toys::shot(fmt::format("s{}", i), "one", velocity,
                                   {{"final_length_mm", measured, 0.003 * exact}}));
    }
    const DataSet set = make_data_set(shots, settings.fit_sizes);
    const ParameterSpace space(settings.parameters, set.lots);
    return sample_posterior(settings, set, space, model, {1});
}

double mean_spread(const Posterior& posterior, const SpreadLevels& levels) {
    double mean = 0;
    for (std::size_t i = 0; i < posterior.pool.levels.size(); ++i)
        mean += posterior.pool.weights(static_cast<Eigen::Index>(i)) *
                levels.values[posterior.pool.levels[i]];
    return mean;
}

}  // namespace

TEST_CASE("the unexplained spread finds what the errors leave out", "[spread]") {
    Settings settings;
    settings.unexplained_spread =
        UnexplainedSpread{0.02, {0, 0.002, 0.004, 0.007, 0.01, 0.013, 0.016, 0.02, 0.03}};
    const SpreadLevels levels = spread_levels(settings);
    const double extra = GENERATE(0.0, 0.013);
    CAPTURE(extra);
    const Posterior posterior = calibrate_line(extra, settings);
    // 60 values tell a spread to about extra / sqrt(2 * 60) = 9 %.
    CHECK(mean_spread(posterior, levels) == Approx(extra).margin(0.0025));
}

TEST_CASE("the paper's sigma is the spread of all relative deviations", "[spread]") {
    Settings settings;
    settings.likelihood = LikelihoodForm::paper;
    settings.network_errors = NetworkErrors::independent;
    const Posterior posterior = calibrate_line(0.013, settings);
    const double sigma = std::hypot(0.003, 0.013);
    CHECK(mean_spread(posterior, spread_levels(settings)) == Approx(sigma).margin(0.003));
    CHECK(posterior.kept.units.col(0).mean() == Approx(0.5).margin(0.01));
}
