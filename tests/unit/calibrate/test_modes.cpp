#include "calibrate/posterior/maps.hpp"
#include "calibrate/posterior/maxima.hpp"
#include "calibrate/sampling/sample_posterior.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

// The length sees |x - 0.4| only, and the diameter, weakly, where x lies: two modes at
// x = 0.2 and 0.6 whose shares follow from two Gaussians.
constexpr double lower_mode = 0.2, upper_mode = 0.6, length_sd = 0.02, tilt_sd = 0.4;

Eigen::VectorXd two_valued(const Shot&, const Eigen::VectorXd& p) {
    Eigen::VectorXd f(2);
    f << 10 + std::abs(p(0) - 0.4), 10 + p(0) + 0.1 * (p(1) - 0.5);
    return f;
}

struct BimodalCase {
    Settings settings;
    toys::ClosedForm model{two_valued, Eigen::MatrixXd::Zero(2, 2)};
    DataSet set;
    double lower_share = 0;

    BimodalCase() {
        settings.parameters = {{"x", 0, 1, false, false}, {"y", 0, 1, false, false}};
        settings.fit_sizes = {"final_length_mm", "impact_diameter_mm"};
        settings.velocity_sd_relative = 0;
        set = make_data_set({toys::shot("a", "one", 150,
                                        {{"final_length_mm", 10.2, length_sd},
                                         {"impact_diameter_mm", 10.3, tilt_sd}})},
                            settings.fit_sizes);
        // The tilt hardly varies over a mode's width; y only adds a flat direction.
        const auto height = [](double x) {
            double sum = 0;
            for (int i = 0; i < 1000; ++i) {
                const double z = (0.3 - x - 0.1 * ((i + 0.5) / 1000 - 0.5)) / tilt_sd;
                sum += std::exp(-0.5 * z * z);
            }
            return sum;
        };
        lower_share = height(lower_mode) / (height(lower_mode) + height(upper_mode));
    }
};

}  // namespace

TEST_CASE("both modes of a two-valued model are found with their shares", "[modes]") {
    const BimodalCase c;
    const ParameterSpace space(c.settings.parameters, c.set.lots);
    const Posterior posterior = sample_posterior(c.settings, c.set, space, c.model, {1});
    double below = 0;
    for (Eigen::Index i = 0; i < posterior.pool.weights.size(); ++i)
        if (posterior.pool.units(i, 0) < 0.4) below += posterior.pool.weights(i);
    const double error =
        std::sqrt(c.lower_share * (1 - c.lower_share) / posterior.effective_sample_size);
    CHECK(std::abs(below - c.lower_share) < 4 * error + 0.005);

    const LotLikelihood likelihood(c.settings, c.set, space, c.model,
                                   posterior.reference);
    const auto maxima = find_maxima(likelihood, posterior.kept, posterior.log_evidence);
    REQUIRE(maxima.size() == 2);
    CHECK(maxima[0].log_density >= maxima[1].log_density);
    for (const Maximum& maximum : maxima) {
        const bool is_lower = maximum.unit(0) < 0.4;
        CHECK(maximum.unit(0) == Approx(is_lower ? lower_mode : upper_mode).margin(0.01));
        CHECK(maximum.share ==
              Approx(is_lower ? c.lower_share : 1 - c.lower_share).margin(0.05));
    }
}

TEST_CASE("maps are densities over their edges", "[modes]") {
    const BimodalCase c;
    const ParameterSpace space(c.settings.parameters, c.set.lots);
    const Posterior posterior = sample_posterior(c.settings, c.set, space, c.model, {1});
    const Maps maps = make_maps(posterior.pool, space, spread_levels(c.settings));
    REQUIRE(maps.single.size() == 2);
    REQUIRE(maps.pairs.size() == 1);
    for (const Map1d& map : maps.single) {
        double mass = 0;
        for (std::size_t i = 0; i < map.density.size(); ++i)
            mass += map.density[i] * (map.edges[i + 1] - map.edges[i]);
        CHECK(mass == Approx(1));
    }
    const Map2d& pair = maps.pairs.front();
    double mass = 0, below = 0;
    for (std::size_t i = 0; i + 1 < pair.x_edges.size(); ++i)
        for (std::size_t j = 0; j + 1 < pair.y_edges.size(); ++j) {
            const double cell =
                pair.density(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                (pair.x_edges[i + 1] - pair.x_edges[i]) *
                (pair.y_edges[j + 1] - pair.y_edges[j]);
            mass += cell;
            if (pair.x_edges[i + 1] < 0.4) below += cell;
        }
    CHECK(mass == Approx(1));
    CHECK(below == Approx(c.lower_share).margin(0.03));
}

TEST_CASE("the refined maximum of a lot's parameters averages over them", "[modes]") {
    // The lot's own parameter is known the better the larger the shared one: by the
    // factor 1 + 4 s. The joint density has no slope in s; averaged over the own
    // parameter it falls as 1 / (1 + 4 s), and the length pulls back to s = 0.5: maximum
    // of -(s - 0.5)^2 / (2 sd^2) - ln(1 + 4 s).
    Settings settings;
    settings.parameters = {{"s", 0, 1, false, false}, {"own", 0, 1, false, true}};
    settings.fit_sizes = {"final_length_mm", "impact_diameter_mm"};
    settings.velocity_sd_relative = 0;
    const double sd = 0.15;
    const toys::ClosedForm model(
        [](const Shot&, const Eigen::VectorXd& p) {
            Eigen::VectorXd f(2);
            f << 10 + p(0), 10 + (1 + 4 * p(0)) * (p(1) - 0.5);
            return f;
        },
        Eigen::MatrixXd::Zero(2, 2));
    const DataSet set = make_data_set(
        {toys::shot("a", "one", 150,
                    {{"final_length_mm", 10.5, sd}, {"impact_diameter_mm", 10, 0.05}})},
        settings.fit_sizes);
    const ParameterSpace space(settings.parameters, set.lots);
    const Posterior posterior = sample_posterior(settings, set, space, model, {1});
    const LotLikelihood likelihood(settings, set, space, model, posterior.reference);
    const auto maxima = find_maxima(likelihood, posterior.kept, posterior.log_evidence);
    double best = 0, height = -1e9;
    for (double s = 0; s <= 1; s += 1e-4) {
        const double h = -0.5 * std::pow((s - 0.5) / sd, 2) - std::log(1 + 4 * s);
        if (h > height) {
            height = h;
            best = s;
        }
    }
    REQUIRE(maxima.size() == 1);
    CHECK(maxima[0].unit(0) == Approx(best).margin(0.01));
    CHECK(maxima[0].unit(1) == Approx(0.5).margin(0.005));
}
