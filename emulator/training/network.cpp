#include "emulator/training/network.hpp"

#include "emulator/inference/dense.hpp"
#include "emulator/training/streams.hpp"

#include <cmath>
#include <utility>

namespace taylorcal::emulator {

namespace {

/// Mean of silu(z)^2 for a standard normal z: what a hidden layer leaves of a signal's
/// size (by quadrature).
constexpr double silu_second_moment = 0.35577;

}  // namespace

template <typename Scalar>
void Network<Scalar>::make_room(const std::vector<Eigen::Index>& widths) {
    Eigen::Index size = 0;
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
        const Eigen::Index weights = widths[i + 1] * widths[i];
        places_.push_back({widths[i + 1], widths[i], size, size + weights});
        size += weights + widths[i + 1];
    }
    parameters_ = Vector::Zero(size);
    gradient_ = Vector::Zero(size);
    is_weight_ = Vector::Zero(size);
    for (const Place& place : places_)
        is_weight_.segment(place.weights, place.bias - place.weights) = 1;
    activations_.resize(places_.size());
    slopes_.resize(places_.size());
    deltas_.resize(places_.size());
}

template <typename Scalar>
Network<Scalar>::Network(const std::vector<Eigen::Index>& widths, std::uint64_t seed) {
    make_room(widths);
    const RandomStream random(seed, streams::weights);
    for (std::size_t layer = 0; layer < places_.size(); ++layer) {
        const Place& place = places_[layer];
        const double incoming =
            static_cast<double>(place.cols) * (layer == 0 ? 1 : silu_second_moment);
        for (Eigen::Index i = place.weights; i < place.bias; ++i) {
            parameters_[i] = static_cast<Scalar>(
                random.normal(static_cast<std::uint64_t>(i)) / std::sqrt(incoming));
        }
    }
}

template <typename Scalar>
Network<Scalar>::Network(const std::vector<Layer>& layers) {
    std::vector<Eigen::Index> widths = {layers.front().weights.cols()};
    for (const Layer& layer : layers) widths.push_back(layer.weights.rows());
    make_room(widths);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const Place& place = places_[i];
        Eigen::Map<RowMajor>(parameters_.data() + place.weights, place.rows, place.cols) =
            layers[i].weights.template cast<Scalar>();
        parameters_.segment(place.bias, place.rows) =
            layers[i].bias.array().template cast<Scalar>();
    }
}

template <typename Scalar>
auto Network<Scalar>::weights(std::size_t layer) const -> Eigen::Map<const RowMajor> {
    const Place& place = places_[layer];
    return {parameters_.data() + place.weights, place.rows, place.cols};
}

template <typename Scalar>
void Network<Scalar>::add_forward(std::size_t layer) {
    const Place& place = places_[layer];
    const Block& inputs = layer == 0 ? inputs_ : activations_[layer - 1];
    const Eigen::Index width = inputs.cols();
    const Scalar* bias = parameters_.data() + place.bias;
    Block& result = activations_[layer];
    result.resize(place.rows, width);
    multiply<Scalar>(
        {parameters_.data() + place.weights, place.rows, place.cols, place.cols, 1},
        inputs.data(), result.data(), width);
    if (layer + 1 == places_.size()) {
        add_bias(result.data(), bias, place.rows, width);
    } else {
        slopes_[layer].resize(place.rows, width);
        activate(result.data(), slopes_[layer].data(), bias, place.rows, width);
    }
}

template <typename Scalar>
auto Network<Scalar>::forward(const Block& inputs) -> Outputs {
    inputs_.setZero(inputs.rows(), padded<Scalar>(inputs.cols()));
    inputs_.leftCols(inputs.cols()) = inputs;
    for (std::size_t layer = 0; layer < places_.size(); ++layer) add_forward(layer);
    return std::as_const(activations_.back()).leftCols(inputs.cols());
}

template <typename Scalar>
Scalar Network<Scalar>::backward(const Block& inputs, const Block& targets,
                                 const Block& mask) {
    const Scalar count = std::max(mask.sum(), Scalar{1});
    const Block difference = mask * (forward(inputs) - targets);
    const Scalar error = difference.square().sum() / count;
    // Samples that pad the block have no error and so no part in any gradient.
    deltas_.back().setZero(difference.rows(), inputs_.cols());
    deltas_.back().leftCols(difference.cols()) = difference * (2 / count);
    for (std::size_t layer = places_.size(); layer-- > 0;) {
        const Place& place = places_[layer];
        const Block& delta = deltas_[layer];
        const Eigen::Index samples = delta.cols();
        const Block& from = layer == 0 ? inputs_ : activations_[layer - 1];
        transposed_.setZero(samples, padded<Scalar>(place.cols));
        transposed_.leftCols(place.cols) = from.transpose();
        product_.resize(place.rows, transposed_.cols());
        multiply<Scalar>({delta.data(), place.rows, samples, samples, 1},
                         transposed_.data(), product_.data(), product_.cols());
        Eigen::Map<RowMajor>(gradient_.data() + place.weights, place.rows, place.cols) =
            product_.leftCols(place.cols).matrix();
        gradient_.segment(place.bias, place.rows) = delta.rowwise().sum();
        if (layer == 0) break;
        Block& before = deltas_[layer - 1];
        before.resize(place.cols, samples);
        multiply<Scalar>(
            {parameters_.data() + place.weights, place.cols, place.rows, 1, place.cols},
            delta.data(), before.data(), samples);
        before *= slopes_[layer - 1];
    }
    return error;
}

template <typename Scalar>
std::vector<Layer> Network<Scalar>::layers() const {
    std::vector<Layer> result;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const auto bias = parameters_.segment(places_[i].bias, places_[i].rows);
        result.push_back(
            {weights(i).template cast<float>(), bias.template cast<float>().matrix()});
    }
    return result;
}

template class Network<float>;
template class Network<double>;

}  // namespace taylorcal::emulator
