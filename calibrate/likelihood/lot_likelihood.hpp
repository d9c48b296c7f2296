#pragma once

#include "calibrate/likelihood/block_likelihood.hpp"
#include "calibrate/likelihood/shot_likelihood.hpp"
#include "calibrate/prediction/predictor.hpp"
#include "calibrate/sampling/parameter_space.hpp"

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// The likelihood of all fitted shots, lot by lot, with the error model held fixed at one
/// reference point: df/dv is the predictor's there, so that C does not move with the
/// parameters and its factor and determinant are computed once.
class LotLikelihood {
  public:
    /// A fitted shot with its errors.
    struct Row {
        Shot shot;
        ShotLikelihood likelihood;
    };
    /// `reference`: a point of the unit cube.
    LotLikelihood(const Settings& settings, const DataSet& set,
                  const ParameterSpace& space, const Predictor& predictor,
                  const Eigen::VectorXd& reference);

    /// ln L of one lot for rows of plain parameters; a column for each spread level.
    RowMatrix operator()(std::size_t lot, const RowMatrix& parameters) const;
    /// Whitened residuals of all fitted shots (columns) for points of the unit cube
    /// (rows).
    RowMatrix whitened(const RowMatrix& units, std::size_t level) const;
    /// ln L of all lots for points of the unit cube; a column for each spread level.
    RowMatrix log_likelihood(const RowMatrix& units) const;

    const SpreadLevels& levels() const { return levels_; }
    const Predictor& predictor() const { return predictor_; }
    const ParameterSpace& space() const { return space_; }
    const Eigen::VectorXd& reference() const { return reference_; }
    /// Predictions of shots that one parameter point (all lots) costs.
    std::size_t shots() const { return shots_; }

    /// Shot by shot; none where errors are in common.
    const std::vector<Row>& rows(std::size_t lot) const { return lots_[lot]; }

  private:
    const ParameterSpace& space_;
    const Predictor& predictor_;
    SpreadLevels levels_;
    Eigen::VectorXd reference_;
    std::vector<std::vector<Row>> lots_;
    std::vector<std::optional<BlockLikelihood>> blocks_;  // where errors are in common
    std::size_t shots_ = 0;
};

}  // namespace taylorcal::calibrate
