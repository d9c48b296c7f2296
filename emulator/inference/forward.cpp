#include "emulator/inference/forward.hpp"

#include "emulator/inference/dense.hpp"

#include <algorithm>

namespace taylorcal::emulator {

ForwardPass::ForwardPass(const Member& member, std::size_t continuous_inputs,
                         const std::vector<OutputInfo>& outputs) {
    for (const Layer& layer : member.layers) {
        layers_.push_back({layer.weights, layer.bias});
        widest_ = std::max({widest_, layer.weights.rows(), layer.weights.cols()});
    }
    Step& first = layers_.front();
    const auto inputs = static_cast<Eigen::Index>(continuous_inputs);
    first_bias_.push_back(first.bias);
    if (first.weights.cols() > inputs) first_bias_.clear();
    for (Eigen::Index column = inputs; column < first.weights.cols(); ++column) {
        first_bias_.emplace_back(first.bias + first.weights.col(column));
    }
    first.weights = Weights(first.weights.leftCols(inputs));
    Step& last = layers_.back();
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const auto scale = static_cast<float>(outputs[i].scale);
        last.weights.row(row) *= scale;
        last.bias[row] = last.bias[row] * scale + static_cast<float>(outputs[i].shift);
    }
}

const Block& ForwardPass::run(int category, Workspace& workspace) const {
    Block* from = &workspace.from;
    Block* to = &workspace.to;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const Weights& weights = layers_[i].weights;
        const Eigen::VectorXf& bias =
            i == 0 ? first_bias_[static_cast<std::size_t>(category)] : layers_[i].bias;
        const Eigen::Index width = from->cols();
        multiply<float>(
            {weights.data(), weights.rows(), weights.cols(), weights.cols(), 1},
            from->data(), to->data(), width);
        if (i + 1 < layers_.size())
            activate(to->data(), bias.data(), weights.rows(), width);
        else
            add_bias(to->data(), bias.data(), weights.rows(), width);
        std::swap(from, to);
    }
    return *from;
}

}  // namespace taylorcal::emulator
