#pragma once

#include "emulator/inference/model.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::emulator {

/// One row a quantity, one column a point: a layer is a small matrix times a wide block,
/// and all arithmetic runs along the points.
using Block = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Points that go through the layers together, so that they stay in the first cache.
inline constexpr Eigen::Index block_width = 128;

/// Scratch of one thread; made once and used for any number of calls.
struct Workspace {
    Block from;
    Block to;
};

/// One member's layers, made ready to run: the standardisation of the outputs is part of
/// the last layer, and the one-hot inputs are a bias of the first for each category
/// value.
class ForwardPass {
  public:
    ForwardPass(const Member& member, std::size_t continuous_inputs,
                const std::vector<OutputInfo>& outputs);

    Eigen::Index widest() const { return widest_; }
    Eigen::Index outputs() const { return layers_.back().weights.rows(); }
    /// Takes standardised inputs in the top rows of workspace.from, whose width is
    /// padded; the returned block (one of the workspace's) has the outputs in its top
    /// rows.
    const Block& run(int category, Workspace& workspace) const;

  private:
    using Weights = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    struct Step {
        Weights weights;
        Eigen::VectorXf bias;
    };
    std::vector<Step> layers_;
    std::vector<Eigen::VectorXf> first_bias_;  ///< By category value.
    Eigen::Index widest_ = 0;
};

}  // namespace taylorcal::emulator
