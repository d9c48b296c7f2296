#include "common/simd.hpp"
#include "emulator/inference/emulator.hpp"
#include "emulator/training/train_member.hpp"

#include <ctime>
#include <functional>

#include <fmt/core.h>

using namespace taylorcal::emulator;
namespace simd = taylorcal::simd;

namespace {

constexpr Eigen::Index inputs = 7, categories = 4, neurons = 29, outputs = 7;
constexpr int hidden_layers = 7;

std::vector<Eigen::Index> widths() {
    std::vector<Eigen::Index> all(hidden_layers + 2, neurons);
    all.front() = inputs + categories;
    all.back() = outputs;
    return all;
}

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

double evaluations_per_second() {
    Model model;
    for (Eigen::Index i = 0; i < inputs; ++i) {
        const Transform transform = i == 0 ? Transform::log10 : Transform::linear;
        model.inputs.push_back({fmt::format("x{}", i), transform, 1, 2, 0, 1, true});
    }
    model.category = {"kind", {"a", "b", "c", "d"}};
    for (Eigen::Index i = 0; i < outputs; ++i) {
        model.outputs.push_back({fmt::format("y{}", i), 0, 1, {"x1", "x2"}});
    }
    model.members.push_back({Network<float>(widths(), 1).layers(), 1, 32, 1e-2, 0});
    const Emulator emulator(std::move(model));
    const Block points = Block::Random(inputs, 512).abs() + 1;
    Block results;
    Workspace workspace;
    return rate(512, [&] { emulator.evaluate(points, 1, results, workspace); });
}

double training_samples_per_second() {
    const Eigen::Index rows = 425;
    const Samples samples{Eigen::MatrixXf::Random(inputs + categories, rows),
                          Eigen::MatrixXf::Random(outputs, rows),
                          Eigen::MatrixXf::Ones(outputs, rows)};
    MemberSettings settings;
    settings.widths = widths();
    settings.epochs = 50;
    return rate(50 * rows, [&] { train_member(settings, samples, samples); });
}

}  // namespace

int main() {
    fmt::print(
        "network of {} inputs, {} categories, {} x {} neurons, {} outputs; {} of the hot "
        "loops\n",
        inputs, categories, hidden_layers, neurons, outputs, simd::name(simd::variant()));
    fmt::print("  {:.2f} million evaluations a CPU second\n",
               1e-6 * evaluations_per_second());
    fmt::print("  {:.2f} million training samples a CPU second (batches of 32)\n",
               1e-6 * training_samples_per_second());
}
