#include "calibrate/sampling/adapt.hpp"
#include "calibrate/sampling/sample_posterior.hpp"
#include "common/random.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/core.h>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

// Two sizes a shot, linear in slope (shared), curvature (shared) and offset (by lot).
Eigen::VectorXd linear_sizes(const Shot& shot, const Eigen::VectorXd& parameters) {
    const double v = shot.velocity_m_s / 100;
    Eigen::VectorXd sizes(2);
    sizes << 20 + parameters(0) * v + parameters(2),
        10 - parameters(1) * v * v + 0.5 * parameters(2);
    return sizes;
}

struct LinearCase {
    Settings settings;
    DataSet set;
    toys::ClosedForm model;
};

/// Noise of `sd` on shots of three lots with offsets of their own.
LinearCase linear_case(double sd, bool per_lot) {
    Settings settings;
    settings.parameters = {{"slope", -2, 2, false, false},
                           {"curvature", -2, 2, false, false},
                           {"offset", -3, 3, false, per_lot}};
    settings.fit_sizes = {"final_length_mm", "impact_diameter_mm"};
    settings.velocity_sd_relative = 0;
    settings.network_errors = NetworkErrors::independent;  // as in the closed form
    settings.draws = sd > 0.1 ? 40000 : 20000;
    settings.draws_per_lot = 16;
    Eigen::MatrixXd network(2, 2);
    network << 0.5, 0.2, 0.2, 0.3;
    network *= sd * sd;
    toys::ClosedForm model(linear_sizes, network);
    const RandomStream noise(7, 1);
    std::vector<Shot> shots;
    const double offsets[] = {0.4, -0.7, 0.1};
    for (int i = 0; i < 9; ++i) {
        const int lot = i % 3;
        Shot shot = toys::shot(fmt::format("s{}", i), fmt::format("lot{}", lot),
                               110 + 13 * i, {});
        Eigen::VectorXd truth(3);
        truth << 0.6, -0.3, per_lot ? offsets[lot] : 0.2;
        const Eigen::VectorXd f = linear_sizes(shot, truth);
        const auto draw = static_cast<std::uint64_t>(2 * i);
        shot.sizes = {
            {"final_length_mm", f(0) + 1.2 * sd * noise.normal(draw), sd},
            {"impact_diameter_mm", f(1) + 1.1 * sd * noise.normal(draw + 1), sd}};
        shots.push_back(shot);
    }
    return {settings, make_data_set(shots, settings.fit_sizes), model};
}

struct Exact {
    double log_evidence;
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
};

/// Closed form in the coordinates of the unit cube; its walls are many sigma away.
Exact exact_posterior(const LinearCase& c, const ParameterSpace& space) {
    const auto p = static_cast<Eigen::Index>(space.size());
    Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(p, p);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(p);
    double log_z = 0.5 * static_cast<double>(p) * std::log(2 * std::numbers::pi);
    for (const Datum* datum : c.set.fitted()) {
        Eigen::MatrixXd covariance = c.model.error_covariance(datum->shot, {});
        covariance.diagonal() += datum->sd_mm.cwiseAbs2();
        const auto predict = [&](const Eigen::VectorXd& unit) -> Eigen::VectorXd {
            const RowMatrix point = unit.transpose();
            return linear_sizes(
                datum->shot, space.lot_parameters(point, datum->lot).row(0).transpose());
        };
        const Eigen::VectorXd origin = predict(Eigen::VectorXd::Zero(p));
        Eigen::MatrixXd design(2, p);
        for (Eigen::Index j = 0; j < p; ++j)
            design.col(j) = predict(Eigen::VectorXd::Unit(p, j)) - origin;
        const Eigen::MatrixXd inverse = covariance.inverse();
        const Eigen::VectorXd r = datum->measured_mm - origin;
        precision += design.transpose() * inverse * design;
        b += design.transpose() * inverse * r;
        log_z -= 0.5 * (r.dot(inverse * r) + std::log(covariance.determinant()) +
                        2 * std::log(2 * std::numbers::pi));
    }
    const Eigen::VectorXd mean = precision.ldlt().solve(b);
    log_z += 0.5 * (b.dot(mean) - std::log(precision.determinant()));
    return {log_z, mean, precision.inverse()};
}

}  // namespace

TEST_CASE("a linear model with Gaussian errors gives its exact evidence and moments",
          "[evidence]") {
    const double sd = GENERATE(0.25, 0.02);
    const bool per_lot = GENERATE(false, true);
    CAPTURE(sd, per_lot);
    const LinearCase c = linear_case(sd, per_lot);
    const ParameterSpace space(c.settings.parameters, c.set.lots);
    const Exact exact = exact_posterior(c, space);
    const Posterior posterior = sample_posterior(c.settings, c.set, space, c.model, {1});

    CAPTURE(posterior.effective_sample_size, posterior.adaptations);
    REQUIRE(posterior.effective_sample_size > enough_draws);
    CHECK(std::abs(posterior.log_evidence - exact.log_evidence) <
          4 * posterior.log_evidence_sd);
    CHECK(posterior.log_evidence_sd < 0.05);

    const Eigen::VectorXd mean =
        posterior.pool.units.transpose() * posterior.pool.weights;
    const RowMatrix centred = posterior.pool.units.rowwise() - mean.transpose();
    const Eigen::MatrixXd covariance =
        centred.transpose() * posterior.pool.weights.asDiagonal() * centred;
    const double tolerance = 5 / std::sqrt(posterior.effective_sample_size);
    for (Eigen::Index i = 0; i < mean.size(); ++i) {
        const double sd_i = std::sqrt(exact.covariance(i, i));
        CHECK(std::abs(mean(i) - exact.mean(i)) < tolerance * sd_i);
        for (Eigen::Index j = 0; j <= i; ++j)
            CHECK(std::abs(covariance(i, j) - exact.covariance(i, j)) <
                  2 * tolerance * sd_i * std::sqrt(exact.covariance(j, j)));
    }
}

TEST_CASE("the nested estimate of the evidence is unbiased", "[evidence]") {
    // Over many seeds the mean of Z (not of ln Z) must be the exact one, even with few
    // draws a lot; a biased nesting would shift it.
    LinearCase c = linear_case(0.25, true);
    c.settings.draws = 1000;
    c.settings.draws_per_lot = 3;
    const ParameterSpace space(c.settings.parameters, c.set.lots);
    const double exact = exact_posterior(c, space).log_evidence;
    double sum = 0, squares = 0;
    constexpr int seeds = 40;
    for (int seed = 0; seed < seeds; ++seed) {
        c.settings.seed = static_cast<std::uint64_t>(seed);
        const double ratio = std::exp(
            sample_posterior(c.settings, c.set, space, c.model, {1}).log_evidence -
            exact);
        sum += ratio;
        squares += ratio * ratio;
    }
    const double mean = sum / seeds;
    const double error = std::sqrt((squares / seeds - mean * mean) / (seeds - 1));
    CAPTURE(mean, error);
    CHECK(error < 0.03);
    CHECK(std::abs(mean - 1) < 3.5 * error);
}

TEST_CASE("a broad posterior is drawn from the prior alone", "[evidence]") {
    // One shot measures the parameter itself: Z = [Phi(b) - Phi(a)] / range, Phi the
    // normal distribution at the walls.
    Settings settings;
    settings.parameters = {{"level", 0, 10, false, false}};
    settings.fit_sizes = {"final_length_mm"};
    settings.velocity_sd_relative = 0;
    const toys::ClosedForm model(
        [](const Shot&, const Eigen::VectorXd& p) { return Eigen::VectorXd(p); },
        Eigen::MatrixXd::Zero(1, 1));
    const double sd = 2, y = 3;
    const DataSet set = make_data_set(
        {toys::shot("a", "one", 150, {{"final_length_mm", y, sd}})}, settings.fit_sizes);
    const ParameterSpace space(settings.parameters, set.lots);
    const Posterior posterior = sample_posterior(settings, set, space, model, {1});
    const double root2 = std::sqrt(2.0);
    const double exact =
        std::log(0.05 * (std::erf((10 - y) / sd / root2) + std::erf(y / sd / root2)));
    CHECK(posterior.drawn_from_prior);
    CHECK(posterior.adaptations == 1);
    CHECK(std::abs(posterior.log_evidence - exact) < 4 * posterior.log_evidence_sd);
}
