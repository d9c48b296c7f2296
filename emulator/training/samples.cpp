#include "emulator/training/samples.hpp"

#include "common/errors.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/core.h>

namespace taylorcal::emulator {

namespace {

struct Moments {
    double mean;
    double deviation;
    Eigen::Index count;
};

/// Of the values that are numbers.
Moments moments(const Eigen::VectorXd& values) {
    double sum = 0, squares = 0;
    Eigen::Index count = 0;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        sum += value;
        ++count;
    }
    const double mean = sum / static_cast<double>(count);
    for (const double value : values) {
        if (std::isfinite(value)) squares += (value - mean) * (value - mean);
    }
    return {mean, std::sqrt(squares / static_cast<double>(count)), count};
}

InputInfo describe_input(const InputChoice& choice, const Eigen::VectorXd& values,
                         const std::vector<Eigen::Index>& training) {
    InputInfo input;
    input.name = choice.name;
    input.transform = choice.transform;
    input.lower = values.minCoeff();
    input.upper = values.maxCoeff();
    require(std::isfinite(transformed(input, input.lower)),
            fmt::format("input \"{}\" has the value {}, of which the transform {} cannot "
                        "be taken. Use \"transform\": \"linear\".",
                        input.name, input.lower, word_of(input.transform)));
    // A spread of the last digits only is a constant that went through arithmetic.
    input.used = input.upper - input.lower > 1e-9 * std::abs(input.upper);
    if (!input.used) return input;
    Eigen::VectorXd seen = values(training);
    for (double& value : seen) value = transformed(input, value);
    const Moments of_seen = moments(seen);
    require(
        of_seen.deviation > 0,
        fmt::format("input \"{}\" varies in held-out rows only. Add runs that vary it.",
                    input.name));
    input.shift = of_seen.mean;
    input.scale = of_seen.deviation;
    return input;
}

/// The shape of all runs; empty if they have several, or none is told of each.
std::string only_shape(const Dataset& data) {
    if (data.shapes.empty() || std::ssize(data.shapes) != data.rows()) return "";
    const auto differs = [&](const std::string& s) { return s != data.shapes.front(); };
    return std::ranges::any_of(data.shapes, differs) ? "" : data.shapes.front();
}

}  // namespace

RowMatrix divided_outputs(const Model& model, const Dataset& data) {
    RowMatrix result = data.outputs;
    for (std::size_t k = 0; k < model.outputs.size(); ++k) {
        for (const std::string& name : model.outputs[k].divide_by) {
            const auto input = std::ranges::find(model.inputs, name, &InputInfo::name);
            result.col(static_cast<Eigen::Index>(k)).array() /=
                data.inputs.col(input - model.inputs.begin()).array();
        }
    }
    return result;
}

Model describe(const TrainConfig& config, const Dataset& data, const Split& split) {
    constexpr std::size_t fewest = 8;
    require(
        split.training.size() >= fewest,
        fmt::format("{}: the database has {} rows to learn from after {} were dropped "
                    "(expected at least {}). Add runs.",
                    data.file, split.training.size(), data.dropped_rows, fewest));
    Model model;
    for (std::size_t i = 0; i < config.inputs.size(); ++i) {
        model.inputs.push_back(describe_input(
            config.inputs[i], data.inputs.col(static_cast<Eigen::Index>(i)),
            split.training));
    }
    if (!config.category.empty()) {
        const std::set<std::string> values(data.categories.begin(),
                                           data.categories.end());
        model.category = {config.category, {values.begin(), values.end()}};
    }
    if (config.category.empty()) model.only_shape = only_shape(data);
    for (const OutputChoice& choice : config.outputs) {
        model.outputs.push_back({choice.name, 0, 1, choice.divide_by});
    }
    model.corrects_cheaper_runs = !data.cheaper.empty();
    const RowMatrix outputs = divided_outputs(model, data);
    for (std::size_t k = 0; k < model.outputs.size(); ++k) {
        OutputInfo& output = model.outputs[k];
        const Moments seen =
            moments(outputs.col(static_cast<Eigen::Index>(k))(split.training));
        require(
            seen.count >= 2 && std::isfinite(seen.deviation),
            fmt::format("{}: output \"{}\" has {} values to learn from. Leave it out of "
                        "the configuration.",
                        data.file, output.name, seen.count));
        output.shift = seen.mean;
        output.scale = seen.deviation > 0 ? seen.deviation : 1;
    }
    return model;
}

Samples standardise(const Model& model, const Dataset& data,
                    const std::vector<Eigen::Index>& rows) {
    const RowMatrix outputs = divided_outputs(model, data);
    const auto n = static_cast<Eigen::Index>(rows.size());
    const auto continuous = std::ranges::count_if(model.inputs, &InputInfo::used);
    const auto values = static_cast<Eigen::Index>(model.category.values.size());
    const Eigen::Index solvers = model.corrects_cheaper_runs ? 1 : 0;
    Samples samples;
    samples.inputs = Eigen::MatrixXf::Zero(continuous + values + solvers, n);
    samples.targets =
        Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(model.outputs.size()), n);
    samples.mask = samples.targets;
    for (Eigen::Index j = 0; j < n; ++j) {
        const Eigen::Index row = rows[static_cast<std::size_t>(j)];
        Eigen::Index to = 0;
        for (std::size_t i = 0; i < model.inputs.size(); ++i) {
            const InputInfo& input = model.inputs[i];
            if (!input.used) continue;
            const double value = data.inputs(row, static_cast<Eigen::Index>(i));
            samples.inputs(to++, j) = static_cast<float>(standardised(input, value));
        }
        for (Eigen::Index c = 0; c < values; ++c) {
            const bool here = model.category.values[static_cast<std::size_t>(c)] ==
                              data.categories[static_cast<std::size_t>(row)];
            samples.inputs(continuous + c, j) = here ? 1.0F : 0.0F;
        }
        if (model.corrects_cheaper_runs)
            samples.inputs(continuous + values, j) =
                data.cheaper[static_cast<std::size_t>(row)];
        for (Eigen::Index k = 0; k < outputs.cols(); ++k) {
            const OutputInfo& output = model.outputs[static_cast<std::size_t>(k)];
            const double value = (outputs(row, k) - output.shift) / output.scale;
            if (!std::isfinite(value)) continue;
            samples.targets(k, j) = static_cast<float>(value);
            samples.mask(k, j) = 1;
        }
    }
    return samples;
}

}  // namespace taylorcal::emulator
