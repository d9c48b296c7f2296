#include "calibrate/likelihood/common_error.hpp"
#include "calibrate/likelihood/errors_of_shot.hpp"
#include "calibrate/likelihood/lot_likelihood.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

using namespace taylorcal::calibrate;
using taylorcal::RowMatrix;

namespace {

const std::vector<std::string> sizes{"final_length_mm", "impact_diameter_mm"};

/// Two lots; the second shot of the first has one size only, the third another shape.
DataSet table() {
    std::vector<Shot> shots{
        toys::shot("a", "one", 100,
                   {{"final_length_mm", 36, 0.3}, {"impact_diameter_mm", 10, 0.2}}),
        toys::shot("b", "one", 110, {{"impact_diameter_mm", 9.7, 0.2}}),
        toys::shot("c", "one", 150,
                   {{"final_length_mm", 33, 0.3}, {"impact_diameter_mm", 11, 0.2}}),
        toys::shot("d", "two", 120, {{"final_length_mm", 35, 0.3}})};
    shots[2].shape = "truncated_cone";
    return make_data_set(shots, sizes);
}

toys::ClosedForm model() {
    Eigen::MatrixXd network(2, 2);
    network << 0.04, 0.03, 0.03, 0.09;
    return {[](const Shot& shot, const Eigen::VectorXd& p) {
                return Eigen::Vector2d(40 * p(0) - 0.05 * shot.velocity_m_s,
                                       6 + 0.04 * shot.velocity_m_s * p(0));
            },
            network};
}

Settings settings_of() {
    Settings settings;
    settings.parameters = {{"rho_immobile_initial", 0.5, 1.5}};
    settings.fit_sizes = sizes;
    settings.unexplained_spread = UnexplainedSpread{0.02, {0, 0.01, 0.05}};
    settings.network_errors = NetworkErrors::common;
    return settings;
}

double log_normal_density(const Eigen::VectorXd& residual, const Eigen::MatrixXd& c) {
    const Eigen::LDLT<Eigen::MatrixXd> factor(c);
    const double log_det = factor.vectorD().array().log().sum();
    return -0.5 * (residual.dot(factor.solve(residual)) + log_det +
                   static_cast<double>(residual.size()) * std::log(2 * std::numbers::pi));
}

}  // namespace

TEST_CASE("shots share the network's error the less the more they differ", "[common]") {
    const DataSet set = table();
    const toys::ClosedForm predictor = model();
    const Shot &a = set.data[0].shot, &b = set.data[1].shot, &c = set.data[2].shot;
    CHECK(common_share(predictor, a, b) == Approx(0.9 * std::exp(-0.1 / 0.21)));
    CHECK(common_share(predictor, a, c) == Approx(0.25 * 0.9 * std::exp(-0.5 / 0.21)));

    const Eigen::VectorXd parameters = Eigen::VectorXd::Ones(1);
    const Settings settings = settings_of();
    const std::vector<const Datum*> shots{&set.data[0], &set.data[1], &set.data[2]};
    const Eigen::MatrixXd all = lot_covariance(settings, predictor, shots, parameters);
    REQUIRE(all.rows() == 5);
    CHECK((all - all.transpose()).norm() == 0);
    CHECK(all.llt().info() == Eigen::Success);
    CHECK((all.topLeftCorner(2, 2) -
           fixed_covariance(settings, predictor, set.data[0], parameters))
              .norm() < 1e-12);
    // The error's covariance is the same for all shots here, so that E^(1/2) E^(1/2) = E.
    const double share = common_share(predictor, a, b);
    CHECK(all(0, 2) == Approx(share * 0.03));
    CHECK(all(1, 2) == Approx(share * 0.09));
    CHECK(all(0, 3) == Approx(common_share(predictor, a, c) * 0.04));
}

TEST_CASE("ln L of a lot is the normal density of all its sizes at once", "[common]") {
    const DataSet set = table();
    const toys::ClosedForm predictor = model();
    const Settings settings = settings_of();
    const ParameterSpace space(settings.parameters, set.lots);
    const Eigen::VectorXd reference = Eigen::VectorXd::Constant(1, 0.5);
    const LotLikelihood likelihood(settings, set, space, predictor, reference);
    RowMatrix units(2, 1);
    units << 0.3, 0.55;
    const RowMatrix found = likelihood.log_likelihood(units);
    for (Eigen::Index i = 0; i < 2; ++i) {
        const RowMatrix parameters = space.lot_parameters(units.row(i), 0);
        for (std::size_t g = 0; g < 3; ++g) {
            double expected = 0;
            for (const std::vector<std::size_t>& lot :
                 {std::vector<std::size_t>{0, 1, 2}, std::vector<std::size_t>{3}}) {
                std::vector<const Datum*> shots;
                std::vector<double> residual, spread;
                for (const std::size_t k : lot) {
                    const Datum& datum = set.data[k];
                    shots.push_back(&datum);
                    const RowMatrix predicted = predictor.predict(datum.shot, parameters);
                    for (std::size_t s = 0; s < datum.columns.size(); ++s) {
                        const double y = datum.measured_mm(static_cast<Eigen::Index>(s));
                        residual.push_back(y - predicted(0, datum.columns[s]));
                        spread.push_back(
                            std::pow(settings.unexplained_spread->grid[g] * y, 2));
                    }
                }
                // df/dv is taken at the reference, where the parameter is 1.
                Eigen::MatrixXd c =
                    lot_covariance(settings, predictor, shots, Eigen::VectorXd::Ones(1));
                c.diagonal() +=
                    Eigen::Map<const Eigen::VectorXd>(spread.data(), std::ssize(spread));
                expected += log_normal_density(Eigen::Map<const Eigen::VectorXd>(
                                                   residual.data(), std::ssize(residual)),
                                               c);
            }
            CHECK(found(i, static_cast<Eigen::Index>(g)) ==
                  Approx(expected).epsilon(1e-10));
        }
    }
    // Whitened residuals: their squares are the misfit.
    for (std::size_t g = 0; g < 3; ++g) {
        const RowMatrix whitened = likelihood.whitened(units, g);
        REQUIRE(whitened.cols() == 6);
        const double by_misfit =
            -0.5 * (whitened.row(0).squaredNorm() - whitened.row(1).squaredNorm());
        const auto column = static_cast<Eigen::Index>(g);
        CHECK(by_misfit == Approx(found(0, column) - found(1, column)).epsilon(1e-9));
    }
}
