#include "calibrate/prior_pass/data_subsets.hpp"
#include "calibrate/prior_pass/layer_kernel.hpp"
#include "calibrate/prior_pass/sample_prior.hpp"
#include "tests/unit/calibrate/toy_models.hpp"
#include "tests/unit/calibrate/toy_network.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/core.h>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

/// Three sizes, linear in three parameters (one of them log-uniform) and the velocity.
struct LinearProblem {
    Settings settings;
    Eigen::MatrixXd weights{3, 4};
    Eigen::VectorXd bias{3};
    Eigen::MatrixXd network_errors{3, 3};
    DataSet set;

    LinearProblem() {
        settings.parameters = {{"a", -1, 3, false, false},
                               {"b", 1e10, 1e15, true, false},
                               {"c", 0, 5, false, false}};
        settings.fit_sizes = {"final_length_mm", "impact_diameter_mm", "head_length_mm"};
        settings.velocity_sd_relative = 0;
        settings.draws_from = DrawsFrom::prior;
        settings.network_errors = NetworkErrors::independent;
        settings.draws = 400000;
        settings.kept_draws = 500;
        weights << -2, 3, 1, 0.2, 1.5, -1, 2, 0.4, 0.1, 0.5, -0.6, 2.5;
        bias << 40, 8, 10;
        network_errors << 0.02, 0.01, 0, 0.01, 0.03, 0.005, 0, 0.005, 0.02;
        const Eigen::Vector3d truth(0.45, 0.55, 0.5);
        const RandomStream noise(3, 1);
        std::vector<Shot> shots;
        for (std::uint64_t i = 0; i < 8; ++i) {
            Eigen::Vector4d x;
            x << 0.1 * static_cast<double>(i), truth;
            const Eigen::VectorXd f = weights * x + bias;
            const double v = 100 + 10.0 * static_cast<double>(i);
            shots.push_back(toys::shot(
                fmt::format("s{}", i), "one", v,
                {{"final_length_mm", f(0) + 0.5 * noise.normal(3 * i), 0.5},
                 {"impact_diameter_mm", f(1) + 0.5 * noise.normal(3 * i + 1), 0.5},
                 {"head_length_mm", f(2) + 0.5 * noise.normal(3 * i + 2), 0.5}}));
        }
        for (std::size_t i = 4; i < 8; ++i) shots[i].shape = "truncated_cone";
        set = make_data_set(shots, settings.fit_sizes);
    }
    NetworkPredictor predictor() const {
        return toys::network(settings, toys::linear_layer(weights, bias), network_errors);
    }
    struct Exact {
        double log_evidence;
        Eigen::VectorXd mean;
        Eigen::MatrixXd covariance;
    };
    /// Closed form; the cube's walls are several sigma away.
    Exact exact() const {
        const Eigen::MatrixXd design = weights.rightCols(3);
        const Eigen::MatrixXd covariance =
            network_errors + 0.25 * Eigen::MatrixXd::Identity(3, 3);
        const Eigen::MatrixXd inverse = covariance.inverse();
        Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(3, 3);
        Eigen::VectorXd b = Eigen::VectorXd::Zero(3);
        double log_z = 1.5 * std::log(2 * std::numbers::pi);
        for (const Datum* datum : set.fitted()) {
            const Eigen::VectorXd r =
                datum->measured_mm - bias -
                weights.col(0) * (datum->shot.velocity_m_s - 100) / 100;
            precision += design.transpose() * inverse * design;
            b += design.transpose() * inverse * r;
            log_z -= 0.5 * (r.dot(inverse * r) + std::log(covariance.determinant()) +
                            3 * std::log(2 * std::numbers::pi));
        }
        const Eigen::VectorXd mean = precision.ldlt().solve(b);
        log_z += 0.5 * (b.dot(mean) - std::log(precision.determinant()));
        return {log_z, mean, precision.inverse()};
    }
};

double evidence(const LinearProblem& problem, DrawSequence sequence, std::uint64_t seed,
                double* sd = nullptr) {
    Settings settings = problem.settings;
    settings.draw_sequence = sequence;
    settings.seed = seed;
    settings.draws = UnitSequence::block * UnitSequence::replicates;
    const ParameterSpace space(settings.parameters, problem.set.lots);
    const Posterior found =
        sample_prior(settings, problem.set, space, problem.predictor(), {}).posterior;
    if (sd) *sd = found.log_evidence_sd;
    return found.log_evidence;
}

}  // namespace

TEST_CASE("plain draws give a linear model's exact evidence and moments", "[plain]") {
    LinearProblem problem;
    problem.settings.draw_sequence = GENERATE(DrawSequence::random, DrawSequence::sobol);
    const ParameterSpace space(problem.settings.parameters, problem.set.lots);
    const auto exact = problem.exact();
    const PlainResult found =
        sample_prior(problem.settings, problem.set, space, problem.predictor(), {});
    CHECK(found.posterior.log_evidence_sd < 0.02);
    CHECK(std::abs(found.posterior.log_evidence - exact.log_evidence) <
          4 * found.posterior.log_evidence_sd + 1e-4);
    CHECK(found.dropping.mass_bound < 2e-6);
    CHECK(found.dropping.rows_per_draw < 7);
    const Progression& last = found.convergence.back();
    CHECK(found.convergence.size() >= 2);
    CHECK(last.draws == 400000);
    // Moments are of a in -1 .. 3, of log10 b in 10 .. 15, of c in 0 .. 5.
    const double starts[] = {-1, 10, 0}, widths[] = {4, 5, 5};
    const double error = 4 / std::sqrt(last.effective_size);
    for (Eigen::Index i = 0; i < 3; ++i) {
        const double sd = widths[i] * std::sqrt(exact.covariance(i, i));
        CHECK(std::abs(last.mean(i) - starts[i] - widths[i] * exact.mean(i)) <
              error * sd);
        CHECK(std::abs(last.sd(i) / sd - 1) < error);
    }
}

TEST_CASE("what is dropped is less than the bound, and the bound is small", "[plain]") {
    const LinearProblem problem;
    const ParameterSpace space(problem.settings.parameters, problem.set.lots);
    const NetworkPredictor predictor = problem.predictor();
    const LotLikelihood likelihood(problem.settings, problem.set, space, predictor,
                                   Eigen::Vector3d::Constant(0.5));
    const double log_z = problem.exact().log_evidence;
    const auto run = [&](double share) {
        const Pruning pruning(likelihood, log_z, share);
        const RowNetwork network(predictor, likelihood, pruning.misfit_levels());
        const UnitSequence sequence(DrawSequence::random, 1, 3);
        PlainPass pass{network, pruning, sequence, {}, 100000};
        pass.row_order = discriminating_order(network, pruning, sequence);
        RunningResult result(pruning, space, likelihood.levels(), {{0, 0, 0}, {1, 1, 1}},
                             DrawSequence::random, 1, 1000);
        run_plain_pass(pass, result, 1, {});
        return std::pair(result.log_evidence(), result.dropped_bound());
    };
    const auto [all, nothing] = run(1e-80);
    CHECK(nothing < 1e-60);
    for (const double share : {1e-2, 1e-4, 1e-6}) {
        const auto [pruned, bound] = run(share);
        CAPTURE(share, all - pruned, bound);
        CHECK(bound < 1.1 * share);
        CHECK(all - pruned > -1e-7);
        CHECK(all - pruned < bound + 1e-6);
    }
}

TEST_CASE("misfits in single precision are those in double precision", "[plain]") {
    // A network of the paper's layout, all levels of a spread, a shot without one size.
    LinearProblem problem;
    problem.settings.unexplained_spread = UnexplainedSpread{0.02, {0, 0.01, 0.05}};
    problem.set.data[2].columns = {0, 2};
    problem.set.data[2].measured_mm = Eigen::Vector2d(39, 11);
    problem.set.data[2].sd_mm = Eigen::Vector2d(0.4, 0.6);
    problem.set.data[2].scale_mm = Eigen::Vector2d(39, 11);
    const auto layers = toys::random_layers(4, 3, 8);
    const NetworkPredictor predictor = toys::network(
        problem.settings, layers, problem.network_errors, GENERATE(false, true));
    const ParameterSpace space(problem.settings.parameters, problem.set.lots);
    const LotLikelihood likelihood(problem.settings, problem.set, space, predictor,
                                   Eigen::Vector3d::Constant(0.5));
    const Pruning pruning(likelihood, -1e4, 1);
    REQUIRE(pruning.misfits() == 3);
    const RowNetwork network(predictor, likelihood, pruning.misfit_levels());
    std::array<std::vector<std::uint32_t>, UnitSequence::most_dimensions> words;
    constexpr std::size_t count = 100;
    UnitSequence(DrawSequence::sobol, 3, 3).fill(5, count, words);
    RowNetwork::Inputs inputs;
    network.standardise(words, inputs);
    std::vector<std::vector<float>> misfits(3, std::vector<float>(count + chunk_width));
    RowNetwork::Workspace workspace;
    for (std::size_t row = 0; row < network.rows(); ++row)
        network.add_misfits(row, inputs, 0, count, misfits, workspace);
    RowMatrix units(count, 3);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t d = 0; d < 3; ++d)
            units(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(d)) =
                unit_of(words[d][i]);
    const RowMatrix expected = likelihood.log_likelihood(units);
    std::vector<double> terms;
    for (std::size_t i = 0; i < count; ++i) {
        pruning.log_levels([&](std::size_t m) { return misfits[m][i]; }, terms);
        for (std::size_t g = 0; g < 3; ++g) {
            const double exact =
                likelihood.levels().log_mass[g] +
                expected(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(g));
            CHECK(std::abs(terms[g] - exact) < 2e-6 * std::abs(exact) + 1e-4);
        }
    }
}

TEST_CASE("the quick activation is within its stated error", "[plain]") {
    simd::run([&](auto chosen) {
        using V = typename Registers<float, chosen.value>::One;
        double worst = 0;
        for (double t = -200; t < 200; t += 0.0137) {
            const auto at = static_cast<float>(t);
            const double exact = double{at} / (1 + std::exp2(double{at}));
            const double found = scaled_silu(V(at))[0];
            worst = std::max(worst, std::abs(found - exact) / std::max(1.0, std::abs(t)));
        }
        CHECK(worst < 1e-6);
    });
}

TEST_CASE("threads and interruptions leave the bytes as they are", "[plain]") {
    const LinearProblem problem;
    const ParameterSpace space(problem.settings.parameters, problem.set.lots);
    const NetworkPredictor predictor = problem.predictor();
    const LotLikelihood likelihood(problem.settings, problem.set, space, predictor,
                                   Eigen::Vector3d::Constant(0.5));
    const Pruning pruning(likelihood, problem.exact().log_evidence, 1e-6);
    const RowNetwork network(predictor, likelihood, pruning.misfit_levels());
    const UnitSequence sequence(DrawSequence::random, 1, 3);
    PlainPass pass{network, pruning, sequence, {}, UnitSequence::block * 70 + 123};
    for (std::size_t row = 0; row < network.rows(); ++row) pass.row_order.push_back(row);
    const auto path = std::filesystem::temp_directory_path() / "plain_test.checkpoint";
    std::filesystem::remove(path);
    const auto fresh = [&] {
        return RunningResult(pruning, space, likelihood.levels(), {{0, 0, 0}, {1, 1, 1}},
                             DrawSequence::random, 1, 200);
    };
    const auto state = [](RunningResult& result) {
        std::vector<double> all;
        result.visit([&](const char*, const std::vector<double>& values) {
            all.insert(all.end(), values.begin(), values.end());
        });
        const WeightedDraws pool = result.pool();
        all.insert(all.end(), pool.weights.begin(), pool.weights.end());
        for (const double unit : pool.units.reshaped()) all.push_back(unit);
        return all;
    };
    RunningResult once = fresh();
    run_plain_pass(pass, once, 1, {});
    RunningResult parallel = fresh();
    run_plain_pass(pass, parallel, 3, {});
    CHECK(state(parallel) == state(once));
    CHECK(once.draws() == pass.draws);

    struct Killed {};
    RunningResult killed = fresh();
    CHECK_THROWS_AS(run_plain_pass(pass, killed, 2, {path, "key", 0},
                                   [](std::uint64_t) { throw Killed(); }),
                    Killed);
    RunningResult stranger = fresh();
    CHECK(run_plain_pass(pass, stranger, 2, {path, "another key", 1e9}) == 0);
    CHECK(state(stranger) == state(once));
    RunningResult again = fresh();
    CHECK_THROWS_AS(run_plain_pass(pass, again, 2, {path, "key", 0},
                                   [](std::uint64_t) { throw Killed(); }),
                    Killed);
    RunningResult resumed = fresh();
    CHECK(run_plain_pass(pass, resumed, 1, {path, "key", 0}) > 0);
    CHECK(state(resumed) == state(once));
    std::filesystem::remove(path);
}

TEST_CASE("Sobol's sequence fills every stratum and never repeats", "[plain]") {
    const UnitSequence sequence(DrawSequence::sobol, 4, 4);
    std::array<std::vector<std::uint32_t>, UnitSequence::most_dimensions> words, later;
    constexpr std::uint64_t cycle =
        (std::uint64_t{1} << 32U) / UnitSequence::block * UnitSequence::replicates;
    sequence.fill(37, UnitSequence::block, words);
    sequence.fill(37 + cycle, UnitSequence::block, later);
    for (std::size_t d = 0; d < 4; ++d) {
        std::vector<int> hits(UnitSequence::block, 0);
        for (const std::uint32_t word : words[d]) ++hits[word >> 18U];
        CHECK(hits == std::vector<int>(UnitSequence::block, 1));
        CHECK(words[d] != later[d]);
    }
    // Two dimensions at once: every box of a (t, m, s)-net has its share.
    std::vector<int> boxes(64 * 64, 0);
    for (std::size_t i = 0; i < UnitSequence::block; ++i)
        ++boxes[(words[0][i] >> 26U) * 64 + (words[1][i] >> 26U)];
    CHECK(boxes == std::vector<int>(64 * 64, 4));
    UnitSequence(DrawSequence::random, 4, 4).fill(std::uint64_t{1} << 30U, 10, words);
    UnitSequence(DrawSequence::random, 4, 4).fill(0, 10, later);
    CHECK(words[0] != later[0]);
}

TEST_CASE("a low-discrepancy sequence shrinks the error of ln Z", "[plain]") {
    const LinearProblem problem;
    const double exact = problem.exact().log_evidence;
    double random = 0, sobol = 0, stated = 0;
    constexpr int seeds = 6;
    for (int seed = 0; seed < seeds; ++seed) {
        const auto s = static_cast<std::uint64_t>(seed);
        double sd = 0;
        random += std::pow(evidence(problem, DrawSequence::random, s) - exact, 2);
        sobol += std::pow(evidence(problem, DrawSequence::sobol, s, &sd) - exact, 2);
        stated += sd * sd;
    }
    CAPTURE(std::sqrt(random / seeds), std::sqrt(sobol / seeds),
            std::sqrt(stated / seeds));
    CHECK(sobol < random / 16);        // a quarter of the error
    CHECK(sobol < 4 * stated + 1e-8);  // which the replicates tell
}

TEST_CASE("two modes have the shares of their densities", "[plain]") {
    // Hidden neurons silu(z) and silu(-z), z = 20 (x - 0.5): their sum is even in z,
    // their difference is z. The length sees the first only, the diameter, weakly, the
    // second.
    Settings settings;
    settings.parameters = {{"x", 0, 1, false, false}};
    settings.fit_sizes = {"final_length_mm", "impact_diameter_mm"};
    settings.velocity_sd_relative = 0;
    settings.draws_from = DrawsFrom::prior;
    settings.network_errors = NetworkErrors::independent;
    settings.draws = 300000;
    settings.kept_draws = 1000;
    emulator::Layer hidden{Eigen::MatrixXf(2, 2), Eigen::VectorXf(2)};
    hidden.weights << 0, 20, 0, -20;
    hidden.bias << -10, 10;
    emulator::Layer last{Eigen::MatrixXf(2, 2), Eigen::VectorXf(2)};
    last.weights << 1, 1, 0.05f, -0.05f;
    last.bias << 30, 10;
    const NetworkPredictor predictor =
        toys::network(settings, {hidden, last}, Eigen::MatrixXd::Zero(2, 2));
    constexpr double length_sd = 0.3, diameter_sd = 0.5, diameter = 10.15;
    const DataSet set =
        make_data_set({toys::shot("a", "one", 150,
                                  {{"final_length_mm", 35, length_sd},
                                   {"impact_diameter_mm", diameter, diameter_sd}})},
                      settings.fit_sizes);
    double below = 0, total = 0, mean = 0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps, z = 20 * (x - 0.5);
        const double length = (30 + z * std::tanh(z / 2) - 35) / length_sd;
        const double width = (10 + 0.05 * z - diameter) / diameter_sd;
        const double density = std::exp(-0.5 * (length * length + width * width));
        total += density;
        mean += density * x;
        if (x < 0.5) below += density;
    }
    const ParameterSpace space(settings.parameters, set.lots);
    const PlainResult found = sample_prior(settings, set, space, predictor, {});
    double share = 0;
    for (Eigen::Index i = 0; i < found.posterior.pool.weights.size(); ++i)
        if (found.posterior.pool.units(i, 0) < 0.5)
            share += found.posterior.pool.weights(i);
    const double size = 8000;  // of the pool
    CHECK(below / total > 0.1);
    CHECK(below / total < 0.45);
    CHECK(std::abs(share - below / total) < 4 * 0.5 / std::sqrt(size));
    const Progression& last_line = found.convergence.back();
    CHECK(std::abs(last_line.mean(0) - mean / total) <
          4 * last_line.sd(0) / std::sqrt(last_line.effective_size));
}

TEST_CASE("the paper's likelihood needs one misfit for all its levels", "[plain]") {
    LinearProblem problem;
    problem.settings.likelihood = LikelihoodForm::paper;
    problem.settings.draws = 200000;
    const ParameterSpace space(problem.settings.parameters, problem.set.lots);
    const NetworkPredictor predictor = problem.predictor();
    const PlainResult found =
        sample_prior(problem.settings, problem.set, space, predictor, {});
    Settings adapted = problem.settings;
    adapted.draws_from = DrawsFrom::adapted;
    adapted.draws = 20000;
    const Posterior other = sample_posterior(adapted, problem.set, space, predictor, {1});
    CHECK(found.dropping.mass_bound < 2e-6);
    CHECK(std::abs(found.posterior.log_evidence - other.log_evidence) <
          4 * std::hypot(found.posterior.log_evidence_sd, other.log_evidence_sd));
}

TEST_CASE("parts of the table", "[plain]") {
    const LinearProblem problem;
    const auto subsets = data_subsets(problem.set);
    std::vector<std::string> names;
    for (const DataSubset& subset : subsets) names.push_back(subset.name);
    CHECK(names ==
          std::vector<std::string>{"shape_uniform_cylinder", "without_uniform_cylinder",
                                   "shape_truncated_cone", "without_truncated_cone",
                                   "final_length", "impact_diameter", "other_sizes"});
    CHECK(subsets[0].set.fitted().size() == 4);
    CHECK(subsets[4].set.data[3].measured_mm(0) == problem.set.data[3].measured_mm(0));
    CHECK(subsets[6].set.data[3].columns == std::vector<Eigen::Index>{2});
    CHECK(subsets[6].set.data[3].measured_mm(0) == problem.set.data[3].measured_mm(2));
}
