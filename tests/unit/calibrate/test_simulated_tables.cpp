#include "calibrate/likelihood/common_error.hpp"
#include "calibrate/likelihood/errors_of_shot.hpp"
#include "calibrate/sampling/sample_posterior.hpp"
#include "tests/unit/calibrate/toy_models.hpp"
#include "tests/unit/calibrate/toy_network.hpp"

#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <fmt/core.h>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

// Simulation-based calibration (Talts et al. 2018, arXiv 1804.06788): parameters from the
// prior, a table from the parameters with every error that the likelihood knows, and the
// posterior of the table. If both sides mean the same, the true value's rank within the
// posterior is uniform.
constexpr int tables = 200, bins = 10;
constexpr Eigen::Index parameters = 3, sizes = 3, shots = 6;
constexpr double velocity_sd = 0.06;  // relative: it must matter

Settings settings_of_tables() {
    Settings settings;
    settings.parameters = {{"a", 0, 1, false, false},
                           {"b", 1e10, 1e15, true, false},
                           {"c", 0, 5, false, false}};
    settings.fit_sizes = {"final_length_mm", "impact_diameter_mm", "head_length_mm"};
    settings.velocity_sd_relative = velocity_sd;
    settings.unexplained_spread = UnexplainedSpread{0.01, {0, 0.005, 0.01, 0.02}};
    settings.draws = 1500;
    settings.network_errors = NetworkErrors::common;
    return settings;
}

/// A smooth network of one hidden layer whose sizes are 30, 10 and 20 mm and more.
std::vector<emulator::Layer> smooth_layers() {
    constexpr Eigen::Index neurons = 8;
    const RandomStream random(12, 1);
    std::uint64_t counter = 0;
    emulator::Layer hidden{Eigen::MatrixXf(neurons, parameters + 1),
                           Eigen::VectorXf(neurons)};
    emulator::Layer last{Eigen::MatrixXf(sizes, neurons), Eigen::VectorXf(sizes)};
    for (float& w : hidden.weights.reshaped())
        w = static_cast<float>(1.2 * random.normal(counter++));
    for (float& b : hidden.bias) b = static_cast<float>(0.5 * random.normal(counter++));
    for (float& w : last.weights.reshaped())
        w = static_cast<float>(1.5 * random.normal(counter++));
    last.bias << 30, 10, 20;
    return {hidden, last};
}

struct SimulatedTable {
    DataSet set;
    Eigen::VectorXd unit;
    std::size_t level = 0;
};

SimulatedTable simulate(int number, const Settings& settings,
                        const NetworkPredictor& predictor) {
    const RandomStream random(77, static_cast<std::uint64_t>(number));
    std::uint64_t counter = 0;
    SimulatedTable table;
    table.unit.resize(parameters);
    for (double& u : table.unit) u = random.uniform(counter++);
    const SpreadLevels levels = spread_levels(settings);
    double left = random.uniform(counter++);
    while (table.level + 1 < levels.values.size() &&
           left >= std::exp(levels.log_mass[table.level]))
        left -= std::exp(levels.log_mass[table.level++]);
    const ParameterSpace space(settings.parameters, {"one"});
    const RowMatrix plain = space.lot_parameters(table.unit.transpose(), 0);
    std::vector<Datum> data(shots);
    std::vector<const Datum*> lot;
    for (Eigen::Index i = 0; i < shots; ++i) {
        Datum& datum = data[static_cast<std::size_t>(i)];
        datum.shot = toys::shot(fmt::format("s{}", i), "one",
                                80 + 15 * static_cast<double>(i), {});
        datum.columns = {0, 1, 2};
        datum.measured_mm = predictor.predict(datum.shot, plain).row(0).transpose();
        datum.sd_mm = Eigen::Vector3d(0.3, 0.2, 0.25);
        datum.scale_mm = datum.measured_mm;
        lot.push_back(&datum);
    }
    Eigen::MatrixXd covariance =
        lot_covariance(settings, predictor, lot, plain.row(0).transpose());
    Eigen::VectorXd normal(shots * sizes);
    for (Eigen::Index i = 0; i < shots; ++i) {
        auto own = covariance.block<sizes, sizes>(i * sizes, i * sizes);
        own = with_spread(own, data[static_cast<std::size_t>(i)],
                          levels.values[table.level]);
    }
    for (double& z : normal) z = random.normal(counter++);
    const Eigen::VectorXd error =
        Eigen::LLT<Eigen::MatrixXd>(covariance).matrixL() * normal;
    std::vector<Shot> made;
    for (Eigen::Index i = 0; i < shots; ++i) {
        Datum& datum = data[static_cast<std::size_t>(i)];
        for (Eigen::Index k = 0; k < sizes; ++k)
            datum.shot.sizes.push_back({settings.fit_sizes[static_cast<std::size_t>(k)],
                                        datum.measured_mm(k) + error(i * sizes + k),
                                        datum.sd_mm(k)});
        made.push_back(datum.shot);
    }
    table.set = make_data_set(made, settings.fit_sizes);
    return table;
}

/// Posterior probability of a smaller value for each parameter and the spread.
Eigen::VectorXd ranks(const SimulatedTable& table, const Posterior& posterior,
                      int number) {
    const WeightedDraws& pool = posterior.pool;
    Eigen::VectorXd below = Eigen::VectorXd::Zero(parameters + 1);
    const double tie = RandomStream(78, static_cast<std::uint64_t>(number)).uniform(0);
    for (Eigen::Index i = 0; i < pool.weights.size(); ++i) {
        for (Eigen::Index j = 0; j < parameters; ++j)
            if (pool.units(i, j) < table.unit(j)) below(j) += pool.weights(i);
        const std::size_t level = pool.levels[static_cast<std::size_t>(i)];
        if (level < table.level) below(parameters) += pool.weights(i);
        if (level == table.level) below(parameters) += tie * pool.weights(i);
    }
    return below;
}

/// Chi-square of the ranks' histogram (9 degrees of freedom), by parameter.
Eigen::VectorXd uniformity(const Settings& told) {
    const Settings truth = settings_of_tables();
    const Eigen::MatrixXd errors =
        Eigen::Vector3d(0.01, 0.02, 0.01).asDiagonal().toDenseMatrix() +
        Eigen::MatrixXd::Constant(3, 3, 0.005);
    const NetworkPredictor predictor = toys::network(truth, smooth_layers(), errors);
    RowMatrix histogram = RowMatrix::Zero(parameters + 1, bins);
#pragma omp parallel for schedule(dynamic)
    for (int number = 0; number < tables; ++number) {
        const SimulatedTable table = simulate(number, truth, predictor);
        const ParameterSpace space(told.parameters, table.set.lots);
        const Posterior posterior =
            sample_posterior(told, table.set, space, predictor, {1});
        const Eigen::VectorXd rank = ranks(table, posterior, number);
#pragma omp critical(simulated_tables)
        for (Eigen::Index j = 0; j <= parameters; ++j)
            ++histogram(j, std::min(static_cast<Eigen::Index>(rank(j) * bins),
                                    Eigen::Index{bins - 1}));
    }
    constexpr double expected = static_cast<double>(tables) / bins;
    return (histogram.array() - expected).square().rowwise().sum() / expected;
}

constexpr double limit = 27.88;  // of chi-square with 9 degrees of freedom, p = 0.001

}  // namespace

TEST_CASE("ranks of the truth are uniform over 200 simulated tables", "[simulated]") {
    const Eigen::VectorXd chi2 = uniformity(settings_of_tables());
    CAPTURE(chi2.transpose());
    CHECK((chi2.array() < limit).all());
}

TEST_CASE("ranks tell when an error is left out", "[simulated]") {
    Settings told = settings_of_tables();
    told.velocity_sd_relative = 0;
    const Eigen::VectorXd chi2 = uniformity(told);
    CAPTURE(chi2.transpose());
    CHECK(chi2.head(parameters).maxCoeff() > limit);
}
