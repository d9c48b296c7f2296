#include "emulator/training/network.hpp"

#include "emulator/training/streams.hpp"

#include <cmath>

namespace taylorcal::emulator {

namespace {

/// Mean of silu(z)^2 for a standard normal z: what a hidden layer leaves of a signal's
/// size (by quadrature).
constexpr double silu_second_moment = 0.35577;

}  // namespace

template <typename Scalar>
Network<Scalar>::Network(const std::vector<Eigen::Index>& widths, std::uint64_t seed) {
    Eigen::Index size = 0;
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
        const Eigen::Index weights = widths[i + 1] * widths[i];
        places_.push_back({widths[i + 1], widths[i], size, size + weights});
        size += weights + widths[i + 1];
    }
    parameters_ = Vector::Zero(size);
    gradient_ = Vector::Zero(size);
    is_weight_ = Vector::Zero(size);
    const RandomStream random(seed, streams::weights);
    for (std::size_t layer = 0; layer < places_.size(); ++layer) {
        const Place& place = places_[layer];
        const double incoming =
            static_cast<double>(place.cols) * (layer == 0 ? 1 : silu_second_moment);
        for (Eigen::Index i = place.weights; i < place.bias; ++i) {
            parameters_[i] = static_cast<Scalar>(
                random.normal(static_cast<std::uint64_t>(i)) / std::sqrt(incoming));
            is_weight_[i] = 1;
        }
    }
    activations_.resize(places_.size());
    slopes_.resize(places_.size());
    deltas_.resize(places_.size());
}

template <typename Scalar>
auto Network<Scalar>::weights(std::size_t layer) const -> Eigen::Map<const RowMajor> {
    const Place& place = places_[layer];
    return {parameters_.data() + place.weights, place.rows, place.cols};
}

template <typename Scalar>
void Network<Scalar>::add_forward(std::size_t layer, const Block& inputs) {
    Block& result = activations_[layer];
    Block& slope = slopes_[layer];
    result.resize(places_[layer].rows, inputs.cols());
    result.matrix().noalias() = weights(layer) * inputs.matrix();
    result.colwise() += parameters_.segment(places_[layer].bias, places_[layer].rows);
    if (layer + 1 == places_.size()) return;
    slope = 1 / (1 + (-result).exp());  // The logistic function, for now.
    for (Eigen::Index row = 0; row < result.rows(); ++row) {
        auto sum = result.row(row);
        auto logistic = slope.row(row);
        const auto old = (logistic * (1 + sum * (1 - logistic))).eval();
        sum *= logistic;
        logistic = old;
    }
}

template <typename Scalar>
auto Network<Scalar>::forward(const Block& inputs) -> const Block& {
    add_forward(0, inputs);
    for (std::size_t layer = 1; layer < places_.size(); ++layer) {
        add_forward(layer, activations_[layer - 1]);
    }
    return activations_.back();
}

template <typename Scalar>
Scalar Network<Scalar>::backward(const Block& inputs, const Block& targets,
                                 const Block& mask) {
    forward(inputs);
    const Scalar count = std::max(mask.sum(), Scalar{1});
    deltas_.back() = mask * (activations_.back() - targets);
    const Scalar error = deltas_.back().square().sum() / count;
    deltas_.back() *= 2 / count;
    for (std::size_t layer = places_.size(); layer-- > 0;) {
        const Place& place = places_[layer];
        const Block& delta = deltas_[layer];
        const Block& from = layer == 0 ? inputs : activations_[layer - 1];
        Eigen::Map<RowMajor>(gradient_.data() + place.weights, place.rows, place.cols)
            .noalias() = delta.matrix() * from.matrix().transpose();
        gradient_.segment(place.bias, place.rows) = delta.rowwise().sum();
        if (layer == 0) break;
        Block& before = deltas_[layer - 1];
        before.resize(place.cols, delta.cols());
        before.matrix().noalias() = weights(layer).transpose() * delta.matrix();
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
