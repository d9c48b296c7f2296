#include "emulator/inference/emulator.hpp"

#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "emulator/inference/dense.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

namespace taylorcal::emulator {

namespace {

template <typename Items>
std::vector<std::string> names_of(const Items& items) {
    std::vector<std::string> names;
    names.reserve(items.size());
    for (const auto& item : items) names.push_back(item.name);
    return names;
}

int index_of(const std::string& name, const std::vector<std::string>& names,
             const std::string& kind) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
        std::string list;
        for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
        throw InputError(
            fmt::format("the emulator has no {} \"{}\".{} It has: {}.", kind, name,
                        nearest_hint(name, names, " Is \"", "\" meant?"), list));
    }
    return static_cast<int>(found - names.begin());
}

/// Without the column of the cheaper solver, whose input is 0 in every answer.
Model answering(Model model) {
    for (Member& member : model.members) {
        Eigen::MatrixXf& weights = member.layers.front().weights;
        if (model.corrects_cheaper_runs)
            weights = Eigen::MatrixXf(weights.leftCols(weights.cols() - 1));
    }
    model.corrects_cheaper_runs = false;
    return model;
}

}  // namespace

Emulator Emulator::from_file(const std::filesystem::path& path) {
    return Emulator(read_model(path));
}

Emulator::Emulator(Model model) : model_(answering(std::move(model))) {
    for (const Member& member : model_.members) {
        forward_.emplace_back(member, used_inputs(model_), model_.outputs);
    }
    for (const OutputInfo& output : model_.outputs) {
        divisors_.emplace_back();
        for (const std::string& name : output.divide_by) {
            divisors_.back().push_back(input_index(name));
        }
    }
}

Emulator Emulator::answering_with(std::size_t member) const {
    Model model = model_;
    model.best = member;
    return Emulator(std::move(model));
}

int Emulator::input_index(const std::string& name) const {
    return index_of(name, names_of(model_.inputs), "input");
}

int Emulator::output_index(const std::string& name) const {
    return index_of(name, names_of(model_.outputs), "output");
}

void Emulator::check_shape(const std::string& shape) const {
    require(model_.only_shape.empty() || shape == model_.only_shape,
            fmt::format("the emulator learnt from the shape {} only, and cannot tell of "
                        "\"{}\". Add runs of that shape to the database and train again.",
                        model_.only_shape, shape));
}

int Emulator::category_index(const std::string& value) const {
    if (model_.category.values.empty()) return 0;
    return index_of(value, model_.category.values, model_.category.name);
}

void Emulator::check_range(const std::string& name, double value,
                           const std::string& context) const {
    const InputInfo& input = model_.inputs[static_cast<std::size_t>(input_index(name))];
    const double lower = on_range_scale(input, input.lower);
    const double upper = on_range_scale(input, input.upper);
    const double margin = 0.01 * (upper - lower) + 1e-6 * std::abs(upper);
    const double place = on_range_scale(input, value);
    require(place >= lower - margin && place <= upper + margin,
            fmt::format("{}: {} = {} is beyond the emulator's range {:.6g} to {:.6g}. "
                        "Leave this point "
                        "out, or add runs there to the database and train again.",
                        context, name, value, input.lower, input.upper));
}

bool Emulator::has_output(const std::string& output,
                          const std::string& category_value) const {
    const std::vector<std::string>& known = covariance(category_value).outputs;
    return std::ranges::find(known, output) != known.end();
}

double Emulator::divisor(int output,
                         const Eigen::Ref<const Eigen::VectorXd>& point) const {
    double product = 1;
    for (const int input : divisors_[static_cast<std::size_t>(output)])
        product *= point[input];
    return product;
}

void Emulator::evaluate_member(std::size_t member, const Block& points, int category,
                               Block& results, Workspace& workspace) const {
    const ForwardPass& forward = forward_[member];
    const Eigen::Index n = points.cols();
    results.resize(forward.outputs(), n);
    const Eigen::Index columns = padded<float>(std::min(block_width, n));
    workspace.from.resize(forward.widest(), columns);
    workspace.to.resize(forward.widest(), columns);
    for (Eigen::Index start = 0; start < n; start += block_width) {
        const Eigen::Index width = std::min(block_width, n - start);
        Eigen::Index row = 0;
        for (std::size_t i = 0; i < model_.inputs.size(); ++i) {
            const InputInfo& input = model_.inputs[i];
            if (!input.used) continue;
            const auto column =
                points.row(static_cast<Eigen::Index>(i)).segment(start, width);
            const auto shift = static_cast<float>(input.shift);
            const auto factor = static_cast<float>(1 / input.scale);
            auto standardised = workspace.from.row(row++);
            // Points that a last, narrow block lacks are given a harmless value.
            standardised.setZero();
            if (input.transform == Transform::log10) {
                constexpr auto per_e = static_cast<float>(std::numbers::log10e);
                standardised.head(width) = (column.log() * per_e - shift) * factor;
            } else if (input.transform == Transform::square_root) {
                standardised.head(width) = (column.sqrt() - shift) * factor;
            } else {
                standardised.head(width) = (column - shift) * factor;
            }
        }
        const Block& outputs = forward.run(category, workspace);
        for (Eigen::Index output = 0; output < results.rows(); ++output) {
            auto result = results.row(output).segment(start, width);
            result = outputs.row(output).head(width);
            for (const int input : divisors_[static_cast<std::size_t>(output)]) {
                result *= points.row(input).segment(start, width);
            }
        }
    }
}

const Covariance& Emulator::covariance(const std::string& category_value) const {
    const auto& values = model_.covariances;
    if (model_.category.values.empty()) return values.front().second;
    const auto found = std::ranges::find(values, category_value,
                                         &std::pair<std::string, Covariance>::first);
    require(found != values.end(),
            fmt::format(
                "the emulator has no validation errors for {} \"{}\". Add runs of it to "
                "the database and train again.",
                model_.category.name, category_value));
    return found->second;
}

Covariance Emulator::covariance_near(const std::string& category_value,
                                     const Eigen::VectorXd& point) const {
    Covariance result = covariance(category_value);
    if (model_.held_out.empty()) return result;
    Eigen::VectorXd place(static_cast<Eigen::Index>(used_inputs(model_)));
    Eigen::Index at = 0;
    for (std::size_t i = 0; i < model_.inputs.size(); ++i)
        if (model_.inputs[i].used)
            place(at++) =
                standardised(model_.inputs[i], point(static_cast<Eigen::Index>(i)));
    std::vector<Eigen::Index> columns;
    for (const std::string& name : result.outputs) columns.push_back(output_index(name));
    const std::string& own = model_.category.values.empty()
                                 ? model_.covariances.front().first
                                 : category_value;
    result.matrix =
        emulator::covariance_near(model_.held_out, own, place, columns, result.matrix);
    return result;
}

}  // namespace taylorcal::emulator
