#include "calibrate/likelihood/block_likelihood.hpp"

#include "common/errors.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

namespace taylorcal::calibrate {

BlockLikelihood::BlockLikelihood(const std::vector<const Datum*>& shots,
                                 const Eigen::MatrixXd& fixed, const SpreadLevels& levels)
    : measured_(fixed.rows()), log_norms_(std::ssize(levels.values)) {
    Eigen::VectorXd scale(fixed.rows());
    Eigen::Index at = 0;
    for (const Datum* datum : shots) {
        const Eigen::Index n = datum->measured_mm.size();
        parts_.push_back({datum->shot, datum->columns, at});
        measured_.segment(at, n) = datum->measured_mm.transpose();
        scale.segment(at, n) = datum->scale_mm.cwiseAbs();
        at += n;
    }
    const Eigen::VectorXd inverse = scale.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        inverse.asDiagonal() * fixed * inverse.asDiagonal());
    projection_ = inverse.asDiagonal() * solver.eigenvectors();
    precisions_.resize(fixed.rows(), log_norms_.size());
    const double log_scale = scale.array().log().sum();
    for (Eigen::Index g = 0; g < log_norms_.size(); ++g) {
        const double spread = levels.values[static_cast<std::size_t>(g)];
        const Eigen::ArrayXd variance = solver.eigenvalues().array() + spread * spread;
        if (!(variance.minCoeff() > 0))
            throw NumericalError("the error covariance of a lot's shots is singular");
        precisions_.col(g) = variance.inverse();
        log_norms_(g) =
            -0.5 * (variance.log().sum() +
                    static_cast<double>(at) * std::log(2 * std::numbers::pi)) -
            log_scale;
    }
}

RowMatrix BlockLikelihood::projected(const Predictor& predictor,
                                     const RowMatrix& parameters) const {
    RowMatrix residuals = measured_.replicate(parameters.rows(), 1);
    for (const Part& part : parts_) {
        const RowMatrix predicted = predictor.predict(part.shot, parameters);
        residuals.middleCols(part.start, std::ssize(part.columns)) -=
            predicted(Eigen::all, part.columns);
    }
    return residuals * projection_;
}

RowMatrix BlockLikelihood::operator()(const Predictor& predictor,
                                      const RowMatrix& parameters) const {
    const RowMatrix squares = projected(predictor, parameters).array().square();
    RowMatrix result = -0.5 * squares * precisions_;
    result.rowwise() += log_norms_;
    return result;
}

RowMatrix BlockLikelihood::whitened(const Predictor& predictor,
                                    const RowMatrix& parameters,
                                    std::size_t level) const {
    const Eigen::RowVectorXd roots =
        precisions_.col(static_cast<Eigen::Index>(level)).cwiseSqrt().transpose();
    RowMatrix result = projected(predictor, parameters);
    result.array().rowwise() *= roots.array();
    return result;
}

}  // namespace taylorcal::calibrate
