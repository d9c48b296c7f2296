#pragma once

#include "calibrate/likelihood/lot_likelihood.hpp"
#include "calibrate/prediction/network_predictor.hpp"
#include "calibrate/prior_pass/unit_sequence.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace taylorcal::calibrate {

/// Misfits of the table's rows for many draws at once, in single precision: the network
/// and the whitening of each row made ready for the parameters alone. All that a row
/// brings to the first layer, its velocity, geometry and shape, is a bias there; its
/// units, its measured sizes and the network's standardisation are part of its last
/// layer, whose outputs are residuals [mm].
class RowNetwork {
  public:
    /// Draws in a structure of arrays: standardised inputs of the network by parameter.
    using Inputs = std::array<std::vector<float>, UnitSequence::most_dimensions>;
    struct Workspace {
        std::vector<float> from, to;
    };
    /// How coordinates of the unit cube become an input of the network: affinely, as the
    /// root of an affine value, or by the prior's quantile, one by one.
    enum class Path { affine, root, general };

    /// For the fitted rows of `likelihood`, with one misfit for each of `levels`.
    RowNetwork(const NetworkPredictor& predictor, const LotLikelihood& likelihood,
               const std::vector<std::size_t>& levels);

    std::size_t rows() const { return rows_.size(); }
    std::size_t misfits() const { return misfits_; }
    std::size_t parameters() const { return inputs_.size(); }

    /// Standardised inputs of draws; `words[d]` are coordinates of the unit cube.
    void standardise(const std::array<std::vector<std::uint32_t>,
                                      UnitSequence::most_dimensions>& words,
                     Inputs& inputs) const;

    /// Adds r^T C^-1 r / 2 of one row to the misfits of draws `first` to `first + count`
    /// (count at most chunk_width). The arrays reach to the next multiple of column_step
    /// beyond the last draw, with finite numbers.
    void add_misfits(std::size_t row, const Inputs& inputs, std::size_t first,
                     std::size_t count, std::vector<std::vector<float>>& misfits,
                     Workspace& workspace) const;

    /// Multiplications of one draw and row, for the arithmetic rate.
    double multiplications() const;

  private:
    struct Layer {
        std::size_t rows = 0, columns = 0;
        std::vector<float> weights;  // packed by tiles
        std::vector<float> bias;
    };
    struct Row {
        std::vector<float> first_bias;  // empty if the first layer is the last
        Layer last;
        std::vector<float> roots;  // by misfit: L^-1 / sqrt 2, lower triangle
    };
    /// From the unit interval to the network's input.
    struct Input {
        const emulator::InputInfo* info;
        Path path;
        float start,
            slope;  // of the input, or of the value under the root; slope by 2^-24
    };
    void add_rows(const NetworkPredictor& predictor, const LotLikelihood& likelihood,
                  const std::vector<std::size_t>& levels);
    double standardised(const Input& input, std::size_t d, double unit) const;

    const ParameterSpace& space_;
    std::size_t misfits_;
    std::vector<Input> inputs_;
    std::vector<Layer> hidden_;  // the first without its bias
    std::vector<Row> rows_;
};

}  // namespace taylorcal::calibrate
