#include "calibrate/comparison/comparison.hpp"
#include "calibrate/likelihood/common_error.hpp"
#include "calibrate/likelihood/errors_of_shot.hpp"
#include "common/random.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>
#include <optional>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;

namespace {

/// y = 40 + a + b v/100 for the length and 10 + a/2 for the diameter, shots of one lot
/// close to each other: most of their errors is the network's, in common. Posterior and
/// predictions of left-out shots are Gaussian with closed forms.
struct NeighbouringShots {
    static constexpr int count = 6;
    Settings settings;
    DataSet set;
    toys::ClosedForm model{[](const Shot& shot, const Eigen::VectorXd& p) {
                               return Eigen::Vector2d(
                                   40 + p(0) + p(1) * shot.velocity_m_s / 100,
                                   10 + p(0) / 2);
                           },
                           Eigen::Vector2d(0.09, 0.04).asDiagonal()};
    Eigen::VectorXd measured{2 * count};
    Eigen::MatrixXd slope{2 * count, 2}, covariance;

    explicit NeighbouringShots(NetworkErrors errors) {
        settings.parameters = {{"a", -20, 20}, {"b", -20, 20}};
        settings.fit_sizes = {"final_length_mm", "impact_diameter_mm"};
        settings.network_errors = errors;
        std::vector<Shot> shots;
        const RandomStream noise(5, 1);
        for (int i = 0; i < count; ++i) {
            const double velocity = 100 + 12 * i;
            const double odd = i == 2 ? 0.4 : 0;
            const auto at = static_cast<std::uint64_t>(2 * i);
            measured.segment(2 * i, 2) << 40.3 + odd + 0.1 * noise.normal(at),
                10.2 + 0.1 * noise.normal(at + 1);
            slope.row(2 * i) << 1, velocity / 100;
            slope.row(2 * i + 1) << 0.5, 0;
            shots.push_back(
                toys::shot(fmt::format("s{}", i), "lot", velocity,
                           {{"final_length_mm", measured(2 * i), 0.08},
                            {"impact_diameter_mm", measured(2 * i + 1), 0.06}}));
        }
        set = make_data_set(shots, settings.fit_sizes);
        const Eigen::VectorXd reference = Eigen::VectorXd::Zero(2);
        covariance = lot_covariance(settings, model, set.fitted(), reference);
        if (errors == NetworkErrors::independent)
            for (int i = 0; i < 2 * count; ++i)
                for (int j = 0; j < 2 * count; ++j)
                    if (i / 2 != j / 2) covariance(i, j) = 0;
    }
    /// Numbers of all shots but `left_out`.
    std::vector<int> places(std::optional<int> left_out) const {
        std::vector<int> all;
        for (int i = 0; i < 2 * count; ++i)
            if (i / 2 != left_out) all.push_back(i);
        return all;
    }
    struct Gaussian {
        Eigen::VectorXd mean;
        Eigen::MatrixXd covariance;
    };
    /// Of (a, b), without one shot.
    Gaussian posterior(std::optional<int> left_out = std::nullopt) const {
        const std::vector<int> used = places(left_out);
        const Eigen::MatrixXd j = slope(used, Eigen::all);
        const Eigen::MatrixXd weight = covariance(used, used).inverse();
        const Eigen::VectorXd zero = measured(used) - Eigen::VectorXd(level()(used));
        const Eigen::MatrixXd spread = (j.transpose() * weight * j).inverse();
        return {spread * j.transpose() * weight * zero, spread};
    }
    /// Predictions at (a, b) = 0.
    Eigen::VectorXd level() const {
        Eigen::VectorXd all(2 * count);
        for (int i = 0; i < 2 * count; ++i) all(i) = i % 2 == 0 ? 40 : 10;
        return all;
    }
    /// chi^2 of a shot predicted from the others, integrated over (a, b).
    double chi2_left_out(int shot) const {
        const std::vector<int> rest = places(shot), own{2 * shot, 2 * shot + 1};
        const Gaussian from_rest = posterior(shot);
        const Eigen::MatrixXd gain =
            covariance(own, rest) * covariance(rest, rest).inverse();
        const Eigen::VectorXd residual = measured - level() - slope * from_rest.mean;
        const Eigen::VectorXd own_residual = residual(own) - gain * residual(rest);
        const Eigen::MatrixXd j = slope(own, Eigen::all) - gain * slope(rest, Eigen::all);
        const Eigen::MatrixXd total = covariance(own, own) -
                                      gain * covariance(rest, own) +
                                      j * from_rest.covariance * j.transpose();
        return own_residual.dot(total.inverse() * own_residual);
    }
    /// The comparison, from draws of the closed form.
    nlohmann::json compare() const {
        constexpr Eigen::Index draws = 20000;
        const Gaussian exact = posterior();
        const Eigen::MatrixXd root = exact.covariance.llt().matrixL();
        const RandomStream noise(9, 2);
        StoredPosterior stored;
        stored.draws.resize(draws, 2);
        for (Eigen::Index k = 0; k < draws; ++k) {
            const auto at = static_cast<std::uint64_t>(2 * k);
            stored.draws.row(k) =
                (exact.mean +
                 root * Eigen::Vector2d(noise.normal(at), noise.normal(at + 1)))
                    .transpose();
        }
        stored.maxima = exact.mean.transpose();
        const auto units = [](const RowMatrix& plain) -> RowMatrix {
            return (plain.array() + 20) / 40;
        };
        stored.units = units(stored.draws);
        stored.maxima_units = units(stored.maxima);
        stored.levels.assign(draws, 0);
        stored.maxima_levels = {0};
        stored.reference = Eigen::VectorXd::Constant(2, 0.5);
        const ParameterSpace space(settings.parameters, set.lots);
        const SpreadLevels levels = spread_levels(settings);
        const ComparisonInputs inputs{settings, set, space, levels, model, stored};
        return to_json(compare_with_measurements(inputs), inputs);
    }
};

void check_influence(const NeighbouringShots& c) {
    const nlohmann::json found = c.compare()["influence"];
    const NeighbouringShots::Gaussian all = c.posterior();
    REQUIRE(found.size() == NeighbouringShots::count);
    for (int s = 0; s < NeighbouringShots::count; ++s) {
        const auto& entry = found[static_cast<std::size_t>(s)];
        CHECK(entry["id"] == fmt::format("s{}", s));
        CHECK(entry["chi2_left_out"].get<double>() ==
              Approx(c.chi2_left_out(s)).epsilon(0.1).margin(0.05));
        const Eigen::VectorXd shift =
            (c.posterior(s).mean - all.mean)
                .cwiseQuotient(all.covariance.diagonal().cwiseSqrt());
        CHECK(entry["largest_shift_sd"].get<double>() ==
              Approx(shift.cwiseAbs().maxCoeff()).epsilon(0.1).margin(0.05));
    }
}

const nlohmann::json& group(const nlohmann::json& comparison, const std::string& key) {
    for (const auto& entry : comparison["groups"])
        if (entry["key"] == key) return entry;
    throw std::out_of_range(key);
}

}  // namespace

TEST_CASE("a shot is left out with what the others say of its error", "[influence]") {
    check_influence(NeighbouringShots(NetworkErrors::common));
}

TEST_CASE("a shot with errors of its own is left out by its likelihood", "[influence]") {
    check_influence(NeighbouringShots(NetworkErrors::independent));
}

TEST_CASE("a group's mean is as sure as its errors in common allow", "[comparison]") {
    const NeighbouringShots c(NetworkErrors::common);
    const nlohmann::json found = c.compare();
    const Eigen::VectorXd sd = c.covariance.diagonal().cwiseSqrt();
    const Eigen::MatrixXd correlations = c.covariance.cwiseQuotient(sd * sd.transpose());
    const std::vector<int> lengths{0, 2, 4, 6, 8, 10};
    const double mean_sd =
        std::sqrt(correlations(lengths, lengths).sum()) / NeighbouringShots::count;
    REQUIRE(mean_sd > 1.5 / std::sqrt(NeighbouringShots::count));
    CHECK(group(found, "final_length_mm")["mean_standardised_sd"].get<double>() ==
          Approx(mean_sd));

    // Draws of the whitened errors of all data.
    const Eigen::MatrixXd root = c.covariance.llt().matrixL();
    const RandomStream noise(11, 3);
    const int n = 2 * NeighbouringShots::count, tables = 20000;
    double sum = 0, sum_of_squares = 0;
    for (int t = 0; t < tables; ++t) {
        Eigen::VectorXd z(n);
        for (int i = 0; i < n; ++i)
            z(i) = noise.normal(static_cast<std::uint64_t>(n * t + i));
        const Eigen::VectorXd error = root * z;
        double mean_square = 0;
        for (int i = 0; i < n; i += 2)
            mean_square += Eigen::MatrixXd(c.covariance.block(i, i, 2, 2))
                               .llt()
                               .matrixL()
                               .solve(error.segment(i, 2))
                               .squaredNorm() /
                           n;
        sum += mean_square / tables;
        sum_of_squares += mean_square * mean_square / tables;
    }
    CHECK(sum == Approx(1).epsilon(0.02));
    CHECK(group(found, "lot")["whitened_rms_sd"].get<double>() ==
          Approx(std::sqrt(sum_of_squares - sum * sum) / 2).epsilon(0.03));
}

TEST_CASE("an error of all shots in common is no direction", "[comparison]") {
    // All lengths 1.5 standard errors off: sure if independent, likely if in common.
    const auto words = [](NetworkErrors errors) {
        NeighbouringShots c(errors);
        std::vector<Shot> shots;
        for (Datum& datum : c.set.data) {
            const double sd = std::sqrt(fixed_covariance(c.settings, c.model, datum,
                                                         Eigen::VectorXd::Zero(2))(0, 0));
            datum.shot.sizes = {{"final_length_mm", 40 + 1.5 * sd, 0.08},
                                {"impact_diameter_mm", 10, 0.06}};
            shots.push_back(datum.shot);
            shots.back().use = Use::validate;
        }
        shots.push_back(shots.front());
        shots.back().lot = "fitted";
        shots.back().use = Use::calibrate;
        shots.back().sizes[0].value_mm = 40;
        c.set = make_data_set(shots, c.settings.fit_sizes);
        StoredPosterior stored;
        stored.draws = stored.maxima = RowMatrix::Zero(1, 2);
        stored.units = stored.maxima_units = RowMatrix::Constant(1, 2, 0.5);
        stored.levels = stored.maxima_levels = {0};
        stored.reference = Eigen::VectorXd::Constant(2, 0.5);
        const ParameterSpace space(c.settings.parameters, c.set.lots);
        const SpreadLevels levels = spread_levels(c.settings);
        const ComparisonInputs inputs{c.settings, c.set, space, levels, c.model, stored};
        return group(to_json(compare_with_measurements(inputs), inputs),
                     "final_length_mm")["words"]
            .get<std::string>();
    };
    CHECK_THAT(words(NetworkErrors::independent), Contains("too short"));
    CHECK_THAT(words(NetworkErrors::common), Contains("within the errors"));
}
