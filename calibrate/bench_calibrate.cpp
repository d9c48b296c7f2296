#include "calibrate/prior_pass/layer_kernel.hpp"
#include "calibrate/prior_pass/sample_prior.hpp"
#include "common/random.hpp"

#include <ctime>
#include <functional>

#include <fmt/core.h>
#include <spdlog/spdlog.h>

// The source paper's sizes: 50 shots with 5 sizes each, 3 parameters, 7 layers of 21
// neurons. The weights are random, and the network makes its own table.

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

constexpr Eigen::Index neurons = 21, inputs = 4;
constexpr int hidden_layers = 7, shots = 50;
const std::vector<std::string> sizes = {"final_length_mm", "impact_diameter_mm",
                                        "head_length_mm", "rear_length_mm",
                                        "transition_diameter_mm"};

/// Times a CPU second, from at least half a second of calls that each do `amount`.
double rate(double amount, const std::function<void()>& work) {
    const std::clock_t start = std::clock();
    double done = 0, elapsed = 0;
    while (elapsed < 0.5) {
        work();
        done += amount;
        elapsed = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    return done / elapsed;
}

/// Multiply-adds of single precision a second that the processor does at best.
double arithmetic_limit() {
    constexpr int sums = 12, rounds = 20000;
    float result = 0;
    std::size_t lanes = 1;
    const auto work = [&] {
        simd::run([&](auto chosen) {
            using V = typename Registers<float, chosen.value>::One;
            lanes = V::lanes;
            V sum[sums];
            for (int i = 0; i < sums; ++i) sum[i] = V(static_cast<float>(i));
            const V factor = 0.999f + result * 0, shift = 0.001f;
            for (int k = 0; k < rounds; ++k)
#pragma GCC unroll 12
                for (int i = 0; i < sums; ++i) sum[i] = sum[i] * factor + shift;
            for (int i = 0; i < sums; ++i) result += sum[i][0];
        });
    };
    work();
    const double found = rate(double{sums} * rounds * static_cast<double>(lanes), work);
    return result == 1 ? 0 : found;  // the sums must not be left out
}

NetworkPredictor random_network(const Settings& settings) {
    emulator::Model model;
    model.inputs.push_back(
        {"velocity_m_s", emulator::Transform::linear, 10, 130, 70, 35, true});
    for (const Parameter& p : settings.parameters)
        model.inputs.push_back(
            {p.name, emulator::Transform::linear, p.lower, p.upper, 0.5, 0.29, true});
    for (const std::string& size : sizes) model.outputs.push_back({size, 20, 2, {}});
    const RandomStream random(3, 1);
    std::uint64_t counter = 0;
    emulator::Member member;
    for (int i = 0; i <= hidden_layers; ++i) {
        const Eigen::Index columns = i == 0 ? inputs : neurons;
        const auto rows =
            i == hidden_layers ? static_cast<Eigen::Index>(sizes.size()) : neurons;
        emulator::Layer layer{Eigen::MatrixXf(rows, columns),
                              Eigen::VectorXf::Zero(rows)};
        for (float& weight : layer.weights.reshaped())
            weight = static_cast<float>(
                random.normal(counter++) *
                std::sqrt((i == 0 ? 1 : 2.8) / static_cast<double>(columns)));
        member.layers.push_back(std::move(layer));
    }
    model.members.push_back(std::move(member));
    const auto n = static_cast<Eigen::Index>(sizes.size());
    model.covariances = {{"all", {sizes, 0.0064 * Eigen::MatrixXd::Identity(n, n)}}};
    return {emulator::Emulator(std::move(model)), settings};
}

DataSet table_of(const NetworkPredictor& network, const Settings& settings) {
    const RandomStream random(4, 1);
    std::uint64_t counter = 0;
    const RowMatrix truth = RowMatrix::Constant(1, 3, 0.4);
    std::vector<Shot> made;
    for (int i = 0; i < shots; ++i) {
        Shot shot;
        shot.id = fmt::format("{}", i);
        shot.lot = "one";
        shot.velocity_m_s = 20 + 2 * i;
        shot.initial_diameter_mm = 8;
        shot.initial_length_mm = 40;
        const RowMatrix f = network.predict(shot, truth);
        for (std::size_t k = 0; k < sizes.size(); ++k)
            shot.sizes.push_back(
                {sizes[k],
                 f(0, static_cast<Eigen::Index>(k)) + 0.13 * random.normal(counter++),
                 0.1});
        made.push_back(shot);
    }
    return make_data_set(made, settings.fit_sizes);
}

}  // namespace

int main() {
    spdlog::set_level(spdlog::level::warn);
    Settings settings;
    settings.parameters = {
        {"a", 0, 1, false, false}, {"b", 0, 1, false, false}, {"c", 0, 1, false, false}};
    settings.fit_sizes = sizes;
    settings.unexplained_spread =
        UnexplainedSpread{0.02, {0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.08}};
    settings.draws_from = DrawsFrom::prior;
    settings.network_errors = NetworkErrors::independent;
    settings.draws = 4000000;
    const NetworkPredictor predictor = random_network(settings);
    const DataSet set = table_of(predictor, settings);
    const ParameterSpace space(settings.parameters, set.lots);
    const LotLikelihood likelihood(settings, set, space, predictor,
                                   Eigen::Vector3d::Constant(0.4));
    const double limit = arithmetic_limit();
    fmt::print("plain draws: {} rows x {} sizes, {} x {} neurons; {} of the hot loops\n",
               shots, sizes.size(), hidden_layers, neurons, simd::name(simd::variant()));

    const RowMatrix points = (RowMatrix::Random(512, 3).array() * 0.5 + 0.5).matrix();
    const double before = rate(512.0, [&] { likelihood.log_likelihood(points); });
    fmt::print("  {:.3g} draws a CPU second through the likelihood of adapted draws\n",
               before);

    const Pruning pruning(likelihood, 0, 1e-6);
    const RowNetwork network(predictor, likelihood, pruning.misfit_levels());
    const UnitSequence sequence(DrawSequence::random, 1, 3);
    std::array<std::vector<std::uint32_t>, UnitSequence::most_dimensions> words;
    sequence.fill(0, chunk_width, words);
    RowNetwork::Inputs standardised;
    network.standardise(words, standardised);
    std::vector<std::vector<float>> misfits(network.misfits(),
                                            std::vector<float>(2 * chunk_width));
    RowNetwork::Workspace workspace;
    const double unpruned = rate(chunk_width, [&] {
        for (std::size_t row = 0; row < network.rows(); ++row)
            network.add_misfits(row, standardised, 0, chunk_width, misfits, workspace);
    });
    const double needed = network.multiplications() * shots;
    fmt::print(
        "  {:.3g} with every row seen; {:.3g} would be the {:.1f} thousand million "
        "multiply-adds a second that this processor does at best (SiLU not counted)\n",
        unpruned, limit / needed, 1e-9 * limit);

    const std::clock_t start = std::clock();
    const PlainResult found = sample_prior(settings, set, space, predictor, {});
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    fmt::print(
        "  {:.3g} with draws dropped (after {:.2f} rows on average; their mass < "
        "{:.0e}), the search for the threshold included\n",
        static_cast<double>(settings.draws) / seconds, found.dropping.rows_per_draw,
        found.dropping.mass_bound);
}
