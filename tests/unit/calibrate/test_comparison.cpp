#include "calibrate/comparison/comparison.hpp"
#include "calibrate/posterior/posterior_file.hpp"
#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/random.hpp"
#include "tests/unit/calibrate/table_file.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;

namespace {

/// A line in velocity with an offset by lot. The data of the fast third are 5 % longer
/// than any line: an effect that the model lacks.
struct LineCase {
    Settings settings;
    DataSet set;
    toys::ClosedForm model{[](const Shot& shot, const Eigen::VectorXd& p) {
                               return Eigen::VectorXd::Constant(
                                   1, 40 - p(0) * shot.velocity_m_s / 10 + p(1));
                           },
                           Eigen::MatrixXd::Constant(1, 1, 1e-4)};

    explicit LineCase(double missing) {
        settings = parse_settings(
            {{"parameters",
              {{{"name", "slope"}, {"lower", 0}, {"upper", 2}},
               {{"name", "offset"}, {"lower", -3}, {"upper", 3}, {"scope", "per_lot"}}}},
             {"fit_sizes", {"final_length_mm"}},
             {"draws", 4000},
             {"draws_per_lot", 8},
             {"kept_draws", 1000}},
            "calibrate.json");
        const RandomStream noise(3, 1);
        std::vector<Shot> shots;
        for (std::uint64_t i = 0; i < 24; ++i) {
            const bool second = i % 2 == 1;
            const double velocity = 100 + 4 * static_cast<double>(i);
            const double exact = 40 - 0.05 * velocity + (second ? 1 : -1);
            const double factor = velocity > 165 ? 1 + missing : 1;
            shots.push_back(toys::shot(
                fmt::format("s{}", i), second ? "two" : "one", velocity,
                {{"final_length_mm", exact * factor + 0.1 * noise.normal(i), 0.1}}));
            if (i % 6 == 0) shots.back().use = Use::validate;
        }
        set = make_data_set(shots, settings.fit_sizes);
    }
    ParameterSpace space() const { return {settings.parameters, set.lots}; }

    PosteriorResult sample(const ParameterSpace& space, int threads) const {
        PosteriorResult result;
        result.posterior = sample_posterior(settings, set, space, model, {threads});
        const LotLikelihood likelihood(settings, set, space, model,
                                       result.posterior.reference);
        result.maps = make_maps(result.posterior.pool, space, likelihood.levels());
        result.maxima =
            find_maxima(likelihood, result.posterior.kept, result.posterior.log_evidence);
        return result;
    }
    /// The comparison, through the file.
    nlohmann::json compare() const {
        const ParameterSpace where = space();
        const SpreadLevels levels = spread_levels(settings);
        const toys::TemporaryFile file("posterior.h5");
        write_posterior(file.path(), sample(where, 2), where, levels, settings);
        const StoredPosterior stored =
            read_posterior(file.path(), where, levels, settings);
        const ComparisonInputs inputs{settings, set, where, levels, model, stored};
        return to_json(compare_with_measurements(inputs), inputs);
    }
};

nlohmann::json group(const nlohmann::json& comparison, const std::string& key) {
    for (const auto& entry : comparison["groups"])
        if (entry["key"] == key) return entry;
    return nullptr;
}

}  // namespace

TEST_CASE("the posterior file has the same bytes for one and two threads", "[files]") {
    const LineCase c(0);
    const ParameterSpace space = c.space();
    const SpreadLevels levels = spread_levels(c.settings);
    const toys::TemporaryFile one("one.h5"), two("two.h5");
    write_posterior(one.path(), c.sample(space, 1), space, levels, c.settings);
    write_posterior(two.path(), c.sample(space, 2), space, levels, c.settings);
    const std::string bytes = read_text(one.path());
    CHECK(bytes.size() > 10000);
    CHECK(bytes == read_text(two.path()));
}

TEST_CASE("a posterior of another configuration is refused", "[files]") {
    LineCase c(0);
    const ParameterSpace space = c.space();
    const SpreadLevels levels = spread_levels(c.settings);
    const toys::TemporaryFile file("posterior.h5");
    write_posterior(file.path(), c.sample(space, 1), space, levels, c.settings);
    c.settings.source["seed"] = 99;
    CHECK_THROWS_WITH(read_posterior(file.path(), space, levels, c.settings),
                      Contains("another configuration"));
    const ParameterSpace other(c.settings.parameters, {"one", "three"});
    CHECK_THROWS_WITH(read_posterior(file.path(), other, levels, c.settings),
                      Contains("offset[three]"));
}

TEST_CASE("a posterior without draws, or with one that is no number, is refused",
          "[files]") {
    const LineCase c(0);
    const ParameterSpace space = c.space();
    const SpreadLevels levels = spread_levels(c.settings);
    const toys::TemporaryFile file("posterior.h5");
    PosteriorResult result = c.sample(space, 1);
    const auto columns = result.posterior.kept.units.cols();
    const auto complaint = [&] {
        write_posterior(file.path(), result, space, levels, c.settings);
        return read_posterior(file.path(), space, levels, c.settings);
    };
    result.posterior.kept.units(1, 0) = std::nan("");
    CHECK_THROWS_WITH(complaint(), Contains("posterior.h5: \"draws\" is ") &&
                                       Contains("not finite") &&
                                       Contains("Sample again"));
    result.posterior.kept.units.resize(0, columns);
    result.posterior.kept.levels.clear();
    CHECK_THROWS_WITH(complaint(), Contains("\"draws\" is 0 x "));
}

TEST_CASE("a model that is right fits within its errors", "[comparison]") {
    const nlohmann::json found = LineCase(0).compare();
    CHECK(found["misfit"]["calibrate"]["n"] == 20);
    CHECK(found["misfit"]["validate"]["n"] == 4);
    CHECK(found["misfit"]["calibrate"]["whitened_rms"].get<double>() < 1.2);
    CHECK(found["conflicts"].empty());
    CHECK(found["findings"].empty());
    for (const auto& parameter : found["parameters"]) {
        const double truth = parameter["name"] == "slope"         ? 0.5
                             : parameter["name"] == "offset[one]" ? -1
                                                                  : 1;
        CHECK(std::abs(parameter["mean"].get<double>() - truth) <
              4 * parameter["sd"].get<double>());
        CHECK(parameter["maximum"].get<double>() > parameter["lower95"].get<double>());
        CHECK(parameter["maximum"].get<double>() < parameter["upper95"].get<double>());
    }
}

TEST_CASE("a comparison's numbers belong together", "[comparison]") {
    const LineCase c(0);
    const nlohmann::json found = c.compare();
    double chi2 = 0;
    for (const auto& shot : found["shots"]) {
        const auto& size = shot["sizes"][0];
        const double residual =
            size["measured"].get<double>() - size["predicted"].get<double>();
        CHECK(size["residual"].get<double>() == Approx(residual));
        // C = 0.1^2 + (slope/10 * 1 % v)^2 + 1e-4; the slope at the reference is 0.5.
        const double of_velocity = 0.05 * 0.01 * shot["velocity_m_s"].get<double>();
        const double sd = std::sqrt(0.01 + of_velocity * of_velocity + 1e-4);
        CHECK(size["whitened"].get<double>() == Approx(residual / sd).epsilon(0.02));
        CHECK(size["predictive_lower"] < size["predictive_mean"]);
        CHECK(size["predictive_mean"] < size["predictive_upper"]);
        CHECK(size["predictive_sd"].get<double>() > 0.1);
        if (shot["use"] == "calibrate")
            chi2 += std::pow(size["whitened"].get<double>(), 2);
    }
    CHECK(found["misfit"]["calibrate"]["chi2"].get<double>() == Approx(chi2));
    CHECK(found["influence"].size() == 20);
    for (const auto& entry : found["influence"])
        CHECK(entry["largest_shift_sd"].get<double>() < 1.5);
    for (const auto& curve : found["curves"]) {
        const double slope = (curve["predicted"].back().get<double>() -
                              curve["predicted"].front().get<double>()) /
                             (curve["velocity_m_s"].back().get<double>() -
                              curve["velocity_m_s"].front().get<double>());
        CHECK(slope == Approx(-0.05).epsilon(0.05));
    }
}

TEST_CASE("where the model fails is said in words", "[comparison]") {
    const nlohmann::json found = LineCase(0.05).compare();
    CHECK(found["misfit"]["calibrate"]["whitened_rms"].get<double>() > 1.5);
    const nlohmann::json fast = group(found, "uniform_cylinder x final_length_mm x high");
    REQUIRE(fast.is_object());
    CHECK(fast["mean_relative"].get<double>() > 0);
    CHECK_THAT(
        fast["words"].get<std::string>(),
        Contains("final length predicted") && Contains("too short at high velocity"));
    CHECK_FALSE(found["findings"].empty());
}

TEST_CASE("a datum out of the prior's reach is named", "[comparison]") {
    LineCase c(0);
    Shot odd = c.set.data[5].shot;
    odd.id = "odd";
    odd.use = Use::validate;  // so that it does not spoil the fit
    odd.sizes[0].value_mm = 70;
    std::vector<Shot> shots;
    for (const Datum& datum : c.set.data) shots.push_back(datum.shot);
    shots.push_back(odd);
    c.set = make_data_set(shots, c.settings.fit_sizes);
    const nlohmann::json found = c.compare();
    REQUIRE(found["conflicts"].size() == 1);
    CHECK(found["conflicts"][0]["id"] == "odd");
    CHECK_THAT(found["conflicts"][0]["words"].get<std::string>(),
               Contains("bad datum or missing effect"));
}
