#pragma once

#include "calibrate/likelihood/spread_levels.hpp"
#include "calibrate/measurements/data_set.hpp"
#include "calibrate/prediction/predictor.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Gaussian likelihood of shots whose errors belong together, at every level of the
/// relative spread: C = F + spread^2 Y^2 with Y = diag(y). With Y^-1 F Y^-1 =
/// Q diag(lambda) Q^T one product with Y^-1 Q whitens a residual for all levels:
/// r^T C^-1 r = sum of (Q^T Y^-1 r)^2 / (lambda + spread^2).
class BlockLikelihood {
  public:
    /// `fixed`: F of all sizes, shot by shot [mm^2]. NumericalError if C is singular.
    BlockLikelihood(const std::vector<const Datum*>& shots, const Eigen::MatrixXd& fixed,
                    const SpreadLevels& levels);

    /// ln L for rows of plain parameters of the lot; a column for each level.
    RowMatrix operator()(const Predictor& predictor, const RowMatrix& parameters) const;
    /// Whitened residuals at one level [points x sizes], turned into the axes of C.
    RowMatrix whitened(const Predictor& predictor, const RowMatrix& parameters,
                       std::size_t level) const;

  private:
    struct Part {
        Shot shot;
        std::vector<Eigen::Index> columns;
        Eigen::Index start;
    };
    /// Q^T Y^-1 (measured - predicted) [points x sizes].
    RowMatrix projected(const Predictor& predictor, const RowMatrix& parameters) const;

    std::vector<Part> parts_;
    Eigen::RowVectorXd measured_;
    Eigen::MatrixXd projection_;  // Y^-1 Q
    Eigen::MatrixXd precisions_;  // [sizes x levels] 1/(lambda + spread^2)
    Eigen::RowVectorXd log_norms_;
};

}  // namespace taylorcal::calibrate
