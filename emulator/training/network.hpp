#pragma once

#include "emulator/inference/model.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::emulator {

/// A dense network with SiLU in its hidden layers, its parameters in one flat vector, and
/// the gradient of its error by back-propagation. float for training, double for tests.
template <typename Scalar>
class Network {
  public:
    using Vector = Eigen::Array<Scalar, Eigen::Dynamic, 1>;
    /// One row a neuron, one column a sample.
    using Block = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// `widths`: inputs, neurons of each hidden layer, outputs. Weights are normal with
    /// the variance that keeps the size of a signal through SiLU layers, biases zero.
    Network(const std::vector<Eigen::Index>& widths, std::uint64_t seed);
    /// A network that was trained before.
    explicit Network(const std::vector<Layer>& layers);

    Vector& parameters() { return parameters_; }
    const Vector& parameters() const { return parameters_; }
    /// 1 for weights, 0 for biases.
    const Vector& is_weight() const { return is_weight_; }

    /// Outputs [outputs x samples], valid until the next call.
    using Outputs = typename Block::ConstColsBlockXpr;
    Outputs forward(const Block& inputs);
    /// Mean of mask (outputs - targets)^2 over the entries with mask 1; its derivative by
    /// the parameters is in gradient(). A block without any entry gives 0.
    Scalar backward(const Block& inputs, const Block& targets, const Block& mask);
    const Vector& gradient() const { return gradient_; }

    std::vector<Layer> layers() const;

  private:
    using RowMajor =
        Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    struct Place {
        Eigen::Index rows, cols, weights,
            bias;  ///< Sizes and offsets in the flat vector.
    };
    Eigen::Map<const RowMajor> weights(std::size_t layer) const;
    void make_room(const std::vector<Eigen::Index>& widths);
    void add_forward(std::size_t layer);

    std::vector<Place> places_;
    Vector parameters_;
    Vector gradient_;
    Vector is_weight_;
    // Columns of these are padded, with samples whose inputs are zero.
    Block inputs_;
    std::vector<Block> activations_;  ///< By layer; the last holds the outputs.
    std::vector<Block> slopes_;       ///< d(activation)/d(sum) of the hidden layers.
    std::vector<Block> deltas_;       ///< d(error)/d(sum)
    Block transposed_;                ///< A layer's inputs, one row a sample.
    Block product_;                   ///< A layer's gradient, padded.
};

extern template class Network<float>;
extern template class Network<double>;

}  // namespace taylorcal::emulator
