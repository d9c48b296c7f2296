#include "calibrate/prediction/network_predictor.hpp"

#include "calibrate/prediction/shot_inputs.hpp"
#include "common/errors.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

constexpr Eigen::Index not_a_parameter = -1;

/// Room at the ends of a trained range, which samples seldom reach: 2 % of its span, in
/// logarithms for densities. An input that was constant in the database may differ by 5
/// %: rooms are not all at 295 K.
bool is_covered(const emulator::InputInfo& input, double value) {
    if (!input.used || input.lower == input.upper)
        return std::abs(value - input.lower) <= 0.05 * std::abs(input.lower);
    const double lower = on_range_scale(input, input.lower);
    const double upper = on_range_scale(input, input.upper);
    const double place = on_range_scale(input, value);
    const double room = 0.02 * (upper - lower);
    return place >= lower - room && place <= upper + room;
}

void check_prior(const Parameter& parameter, const emulator::InputInfo& input) {
    require(
        is_covered(input, parameter.lower) && is_covered(input, parameter.upper),
        fmt::format("the prior of {} ({:g} to {:g}) reaches beyond the emulator's range "
                    "({:g} to {:g}). Narrow the prior, or widen the parameter's range in "
                    "study.yaml so that the database covers it.",
                    parameter.name, parameter.lower, parameter.upper, input.lower,
                    input.upper));
}

}  // namespace

NetworkPredictor::NetworkPredictor(emulator::Emulator emulator, const Settings& settings)
    : emulator_(std::move(emulator)), sizes_(settings.fit_sizes) {
    bind_inputs(settings);
    for (const std::string& size : sizes_)
        outputs_.push_back(emulator_.output_index(size));
}

void NetworkPredictor::bind_inputs(const Settings& settings) {
    const auto& inputs = emulator_.inputs();
    parameter_of_input_.assign(inputs.size(), not_a_parameter);
    for (std::size_t j = 0; j < settings.parameters.size(); ++j) {
        const Parameter& parameter = settings.parameters[j];
        const auto i = static_cast<std::size_t>(emulator_.input_index(parameter.name));
        require(
            !is_shot_input(parameter.name),
            fmt::format("{} cannot be calibrated: it comes from the measurement table.",
                        parameter.name));
        check_prior(parameter, inputs[i]);
        parameter_of_input_[i] = static_cast<Eigen::Index>(j);
    }
    for (std::size_t i = 0; i < inputs.size(); ++i)
        require(
            parameter_of_input_[i] != not_a_parameter || is_shot_input(inputs[i].name) ||
                !inputs[i].used,
            fmt::format("the emulator takes {}, which is neither measured nor among the "
                        "calibrated parameters. Add it to the parameters, or train "
                        "without it.",
                        inputs[i].name));
}

const emulator::InputInfo& NetworkPredictor::velocity() const {
    return emulator_
        .inputs()[static_cast<std::size_t>(emulator_.input_index("velocity_m_s"))];
}

double NetworkPredictor::apart(const Shot& a, const Shot& b) const {
    double sum = 0;
    for (const emulator::InputInfo& input : emulator_.inputs())
        if (input.used && is_shot_input(input.name))
            sum += std::abs(shot_input(input.name, a) - shot_input(input.name, b)) /
                   (input.upper - input.lower);
    return sum;
}

double NetworkPredictor::lowest_velocity_m_s() const { return velocity().lower; }

double NetworkPredictor::highest_velocity_m_s() const { return velocity().upper; }

Eigen::VectorXd NetworkPredictor::shot_point(const Shot& shot) const {
    const auto& inputs = emulator_.inputs();
    Eigen::VectorXd point(static_cast<Eigen::Index>(inputs.size()));
    for (std::size_t i = 0; i < inputs.size(); ++i)
        point(static_cast<Eigen::Index>(i)) = is_shot_input(inputs[i].name)
                                                  ? shot_input(inputs[i].name, shot)
                                                  : inputs[i].lower;
    return point;
}

RowMatrix NetworkPredictor::predict(const Shot& shot, const RowMatrix& parameters) const {
    thread_local emulator::Workspace workspace;
    thread_local emulator::Block points, results;
    const Eigen::VectorXd base = shot_point(shot);
    points.resize(base.size(), parameters.rows());
    for (std::size_t i = 0; i < parameter_of_input_.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        if (parameter_of_input_[i] == not_a_parameter)
            points.row(row).setConstant(static_cast<float>(base(row)));
        else
            points.row(row) =
                parameters.col(parameter_of_input_[i]).transpose().cast<float>().array();
    }
    emulator_.evaluate(points, emulator_.category_index(shot.shape), results, workspace);
    RowMatrix predicted(parameters.rows(), static_cast<Eigen::Index>(outputs_.size()));
    for (std::size_t c = 0; c < outputs_.size(); ++c)
        predicted.col(static_cast<Eigen::Index>(c)) =
            results.row(outputs_[c]).transpose().cast<double>().matrix();
    return predicted;
}

Eigen::MatrixXd NetworkPredictor::error_covariance(
    const Shot& shot, const Eigen::VectorXd& parameters) const {
    const auto n = static_cast<Eigen::Index>(sizes_.size());
    Eigen::VectorXd point = shot_point(shot);
    for (std::size_t i = 0; i < parameter_of_input_.size(); ++i)
        if (parameter_of_input_[i] != not_a_parameter)
            point(static_cast<Eigen::Index>(i)) = parameters(parameter_of_input_[i]);
    const emulator::Covariance source = emulator_.covariance_near(shot.shape, point);
    std::vector<Eigen::Index> at;
    Eigen::VectorXd scale(n);
    for (std::size_t c = 0; c < sizes_.size(); ++c) {
        const auto found =
            std::find(source.outputs.begin(), source.outputs.end(), sizes_[c]);
        at.push_back(found == source.outputs.end() ? -1 : found - source.outputs.begin());
        scale(static_cast<Eigen::Index>(c)) = emulator_.divisor(outputs_[c], point);
    }
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const Eigen::Index a = at[static_cast<std::size_t>(i)];
            const Eigen::Index b = at[static_cast<std::size_t>(j)];
            if (a >= 0 && b >= 0)
                covariance(i, j) =
                    held_out_understate * source.matrix(a, b) * scale(i) * scale(j);
        }
    return covariance;
}

void NetworkPredictor::check_shot(const Datum& datum) const {
    const Shot& shot = datum.shot;
    for (const emulator::InputInfo& input : emulator_.inputs()) {
        if (!is_shot_input(input.name)) continue;
        const double value = shot_input(input.name, shot);
        require(
            is_covered(input, value),
            fmt::format("{} = {:g} is beyond the emulator's range {:g} to {:g}. Widen "
                        "the database's range in study.yaml, or set the shot's use to "
                        "ignore.",
                        input.name, value, input.lower, input.upper));
    }
    const auto& shapes = emulator_.category().values;
    require(shapes.empty() ||
                std::find(shapes.begin(), shapes.end(), shot.shape) != shapes.end(),
            fmt::format("the emulator was not trained on the shape {}. Add the shape to "
                        "the database in study.yaml, or set the shot's use to ignore.",
                        shot.shape));
    emulator_.check_shape(shot.shape);
    const auto& known = emulator_.covariance(shot.shape).outputs;
    for (const Eigen::Index column : datum.columns) {
        const std::string& size = sizes_[static_cast<std::size_t>(column)];
        require(std::find(known.begin(), known.end(), size) != known.end(),
                fmt::format("the emulator has no {} for {}. Remove the size from "
                            "fit_sizes, or empty the cell.",
                            size, shot.shape));
    }
}

void NetworkPredictor::check_ranges(const DataSet& set) const {
    for (const Datum& datum : set.data) {
        try {
            check_shot(datum);
        } catch (const InputError& error) {
            const std::string& place = datum.shot.place;
            throw InputError(fmt::format("{}{}shot {}: {}", place,
                                         place.empty() ? "" : ", ", datum.shot.id,
                                         error.what()));
        }
    }
}

}  // namespace taylorcal::calibrate
