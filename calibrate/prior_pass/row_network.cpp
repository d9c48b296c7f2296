#include "calibrate/prior_pass/row_network.hpp"

#include "calibrate/prior_pass/layer_kernel.hpp"
#include "common/errors.hpp"

#include <algorithm>
#include <numbers>

namespace taylorcal::calibrate {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

RowNetwork::Path path_of(const Parameter& parameter, const emulator::InputInfo& info) {
    if (parameter.normal_scale) return RowNetwork::Path::general;
    if (parameter.log_uniform)
        return info.transform == emulator::Transform::log10 ? RowNetwork::Path::affine
                                                            : RowNetwork::Path::general;
    switch (info.transform) {
        case emulator::Transform::linear:
            return RowNetwork::Path::affine;
        case emulator::Transform::square_root:
            return RowNetwork::Path::root;
        case emulator::Transform::log10:
            break;
    }
    return RowNetwork::Path::general;
}

/// Row-major tiles of next_tile() rows, each packed column by column.
std::vector<float> pack_tiles(const Matrix& weights) {
    std::vector<float> packed;
    const auto rows = static_cast<std::size_t>(weights.rows());
    for (std::size_t row = 0; row < rows;) {
        const std::size_t size = next_tile(rows - row);
        for (Eigen::Index k = 0; k < weights.cols(); ++k)
            for (std::size_t i = row; i < row + size; ++i)
                packed.push_back(
                    static_cast<float>(weights(static_cast<Eigen::Index>(i), k)));
        row += size;
    }
    return packed;
}

std::vector<float> floats(const Vector& values) {
    std::vector<float> result;
    for (const double value : values) result.push_back(static_cast<float>(value));
    return result;
}

/// Columns of the first layer that belong to the calibrated parameters, in their order,
/// and what a shot adds to its sums.
struct FirstLayer {
    Matrix of_parameters;
    Vector of_shot;
};

FirstLayer split_first(const NetworkPredictor& predictor, const Shot& shot,
                       const Matrix& weights, const Vector& bias,
                       Eigen::Index parameters) {
    const emulator::Emulator& emulator = predictor.emulator();
    const Vector point = predictor.shot_point(shot);
    FirstLayer first{Matrix::Zero(weights.rows(), parameters), bias};
    Eigen::Index column = 0;
    for (std::size_t i = 0; i < emulator.inputs().size(); ++i) {
        const emulator::InputInfo& info = emulator.inputs()[i];
        const Eigen::Index parameter = predictor.parameter_of_input(i);
        if (!info.used) continue;
        if (parameter >= 0) {
            first.of_parameters.col(parameter) = weights.col(column);
        } else {
            const double value = point(static_cast<Eigen::Index>(i));
            first.of_shot += weights.col(column) *
                             ((transformed(info, value) - info.shift) / info.scale);
        }
        ++column;
    }
    if (column < weights.cols())
        first.of_shot += weights.col(column + emulator.category_index(shot.shape));
    return first;
}

}  // namespace

RowNetwork::RowNetwork(const NetworkPredictor& predictor, const LotLikelihood& likelihood,
                       const std::vector<std::size_t>& levels)
    : space_(likelihood.space()), misfits_(levels.size()) {
    const std::vector<Parameter>& parameters = space_.parameters();
    if (space_.per_lot_count() > 0)
        throw NumericalError("plain draws are of shared parameters only");
    for (std::size_t d = 0; d < parameters.size(); ++d) {
        const emulator::InputInfo* info = nullptr;
        for (std::size_t i = 0; i < predictor.emulator().inputs().size(); ++i)
            if (predictor.parameter_of_input(i) == static_cast<Eigen::Index>(d))
                info = &predictor.emulator().inputs()[i];
        Input input{info, path_of(parameters[d], *info), 0, 0};
        const bool of_value = input.path == Path::root;
        const double low = of_value ? space_.value(d, 0) : standardised(input, d, 0);
        const double high = of_value ? space_.value(d, 1) : standardised(input, d, 1);
        input.start = static_cast<float>(low);
        input.slope = static_cast<float>((high - low) * 0x1p-24);
        inputs_.push_back(input);
    }
    add_rows(predictor, likelihood, levels);
}

void RowNetwork::add_rows(const NetworkPredictor& predictor,
                          const LotLikelihood& likelihood,
                          const std::vector<std::size_t>& levels) {
    const emulator::Emulator& emulator = predictor.emulator();
    const emulator::Model& model = emulator.model();
    const auto& layers = model.members[model.best].layers;
    const auto parameters = static_cast<Eigen::Index>(inputs_.size());
    const double into = -std::numbers::log2e, out_of = -std::numbers::ln2;
    for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
        Matrix weights = layers[i].weights.cast<double>();
        const Vector bias = layers[i].bias.cast<double>() * into;
        if (i == 0)
            weights = into * split_first(predictor, likelihood.rows(0).front().shot,
                                         weights, bias, parameters)
                                 .of_parameters;
        hidden_.push_back({static_cast<std::size_t>(weights.rows()),
                           static_cast<std::size_t>(weights.cols()), pack_tiles(weights),
                           floats(bias)});
    }
    const Matrix last_weights = layers.back().weights.cast<double>();
    const Vector last_bias = layers.back().bias.cast<double>();
    for (std::size_t lot = 0; lot < space_.lot_count(); ++lot) {
        for (const LotLikelihood::Row& fitted : likelihood.rows(lot)) {
            Row row;
            Matrix weights = last_weights;
            Vector bias = last_bias;
            if (hidden_.empty()) {
                const FirstLayer first =
                    split_first(predictor, fitted.shot, weights, bias, parameters);
                weights = first.of_parameters;
                bias = first.of_shot;
            } else {
                const Matrix first = layers.front().weights.cast<double>();
                row.first_bias = floats(
                    into * split_first(predictor, fitted.shot, first,
                                       layers.front().bias.cast<double>(), parameters)
                               .of_shot);
                weights *= out_of;
            }
            // Residual: measured - divisor (scale network + shift).
            const Vector point = predictor.shot_point(fitted.shot);
            const auto& columns = fitted.likelihood.columns();
            const auto n = static_cast<Eigen::Index>(columns.size());
            Matrix residual(n, weights.cols());
            Vector offset(n);
            for (Eigen::Index k = 0; k < n; ++k) {
                const int output = predictor.outputs()[static_cast<std::size_t>(
                    columns[static_cast<std::size_t>(k)])];
                const auto& info = emulator.outputs()[static_cast<std::size_t>(output)];
                const double divisor = emulator.divisor(output, point);
                residual.row(k) = -divisor * info.scale * weights.row(output);
                offset(k) = fitted.likelihood.measured()(k) -
                            divisor * (info.scale * bias(output) + info.shift);
            }
            row.last = {columns.size(), static_cast<std::size_t>(weights.cols()),
                        pack_tiles(residual), floats(offset)};
            for (const std::size_t level : levels) {
                const Matrix root = fitted.likelihood.inverse_root(level);
                for (Eigen::Index i = 0; i < n; ++i)
                    for (Eigen::Index j = 0; j <= i; ++j)
                        row.roots.push_back(
                            static_cast<float>(root(i, j) / std::numbers::sqrt2));
            }
            rows_.push_back(std::move(row));
        }
    }
}

double RowNetwork::standardised(const Input& input, std::size_t d, double unit) const {
    return (transformed(*input.info, space_.value(d, unit)) - input.info->shift) /
           input.info->scale;
}

void RowNetwork::standardise(
    const std::array<std::vector<std::uint32_t>, UnitSequence::most_dimensions>& words,
    Inputs& inputs) const {
    const std::size_t count = words[0].size();
    const std::size_t padded = count + chunk_width;
    for (std::size_t d = 0; d < inputs_.size(); ++d) {
        const Input& input = inputs_[d];
        inputs[d].resize(padded, 0);
        const std::uint32_t* from = words[d].data();
        float* to = inputs[d].data();
        if (input.path == Path::general) {
            for (std::size_t i = 0; i < count; ++i)
                to[i] = static_cast<float>(standardised(input, d, unit_of(from[i])));
            continue;
        }
        for (std::size_t i = 0; i < count; ++i)
            to[i] = input.start +
                    input.slope *
                        (static_cast<float>(static_cast<int>(from[i] >> 8U)) + 0.5f);
        if (input.path == Path::root) {
            auto values =
                Eigen::Map<Eigen::ArrayXf>(to, static_cast<Eigen::Index>(count));
            values = (values.sqrt() - static_cast<float>(input.info->shift)) *
                     static_cast<float>(1 / input.info->scale);
        }
    }
}

void RowNetwork::add_misfits(std::size_t row, const Inputs& inputs, std::size_t first,
                             std::size_t count, std::vector<std::vector<float>>& misfits,
                             Workspace& workspace) const {
    std::size_t widest = std::max(inputs_.size(), rows_[row].last.rows);
    for (const Layer& layer : hidden_) widest = std::max(widest, layer.rows);
    workspace.from.resize(widest * chunk_width);
    workspace.to.resize(widest * chunk_width);
    const std::size_t columns = (count + column_step - 1) / column_step * column_step;
    const Row& at = rows_[row];
    simd::run([&](auto chosen) {
        using V = typename Registers<float, chosen.value>::One;
        float* from = workspace.from.data();
        float* to = workspace.to.data();
        for (std::size_t d = 0; d < inputs_.size(); ++d)
            for (std::size_t i = 0; i < columns; i += V::lanes)
                V::load(inputs[d].data() + first + i).store(from + d * chunk_width + i);
        for (std::size_t k = 0; k < hidden_.size(); ++k) {
            const Layer& layer = hidden_[k];
            const float* bias = k == 0 ? at.first_bias.data() : layer.bias.data();
            dense_layer<V, true>(layer.weights.data(), bias, layer.rows, layer.columns,
                                 from, to, columns);
            std::swap(from, to);
        }
        dense_layer<V, false>(at.last.weights.data(), at.last.bias.data(), at.last.rows,
                              at.last.columns, from, to, columns);
        for (std::size_t i = 0; i < columns; i += V::lanes) {
            const float* root = at.roots.data();
            for (std::size_t m = 0; m < misfits_; ++m) {
                float* total = misfits[m].data() + first + i;
                V sum = V::load(total);
                for (std::size_t k = 0; k < at.last.rows; ++k) {
                    V whitened = V(*root++) * V::load(to + i);
                    for (std::size_t j = 1; j <= k; ++j)
                        whitened += V(*root++) * V::load(to + j * chunk_width + i);
                    sum += whitened * whitened;
                }
                sum.store(total);
            }
        }
    });
}

double RowNetwork::multiplications() const {
    double sum = 0, rows = 0;
    for (const Layer& layer : hidden_)
        sum += static_cast<double>(layer.rows * layer.columns);
    for (const Row& row : rows_)
        rows += static_cast<double>(row.last.rows * row.last.columns + row.roots.size());
    return sum + rows / static_cast<double>(rows_.size());
}

}  // namespace taylorcal::calibrate
