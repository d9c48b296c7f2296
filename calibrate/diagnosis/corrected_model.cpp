#include "calibrate/diagnosis/corrected_model.hpp"

#include "calibrate/diagnosis/error_budget.hpp"

#include <set>

namespace taylorcal::calibrate {

CorrectedModel::CorrectedModel(const CorrectedPredictor& predictor,
                               const ParameterSpace& space,
                               std::vector<const Datum*> data, Eigen::VectorXd reference)
    : predictor_(predictor),
      space_(space),
      data_(std::move(data)),
      reference_(std::move(reference)) {
    for (const Datum* datum : data_) count_ += datum->measured_mm.size();
}

RowMatrix CorrectedModel::predict(const RowMatrix& units) const {
    RowMatrix all(units.rows(), count_);
    Eigen::Index at = 0;
    for (const Datum* datum : data_) {
        const auto n = static_cast<Eigen::Index>(datum->columns.size());
        all.middleCols(at, n) =
            predictor_.predict(datum->shot, space_.lot_parameters(units, datum->lot))(
                Eigen::all, datum->columns);
        at += n;
    }
    return all;
}

RowMatrix CorrectedModel::shift(std::size_t k, const RowMatrix& units,
                                const Eigen::VectorXd& amplitudes) const {
    RowMatrix all(units.rows(), count_);
    Eigen::Index at = 0;
    for (const Datum* datum : data_) {
        const auto n = static_cast<Eigen::Index>(datum->columns.size());
        all.middleCols(at, n) =
            predictor_.shift(k, datum->shot, space_.lot_parameters(units, datum->lot),
                             amplitudes)(Eigen::all, datum->columns);
        at += n;
    }
    return all;
}

Eigen::VectorXd CorrectedModel::reference_of(const Datum& datum) const {
    return space_.lot_parameters(reference_.transpose(), datum.lot).row(0).transpose();
}

Eigen::MatrixXd CorrectedModel::shift_covariance(std::size_t k) const {
    return effect_errors(predictor_, *this, k);
}

std::string CorrectedModel::why_unseen(std::size_t k) const {
    std::set<std::string> shapes;
    for (const Datum* datum : data_) shapes.insert(datum->shot.shape);
    for (const std::string& shape : shapes)
        if (const std::string why = predictor_.why_unseen(k, shape); !why.empty())
            return why;
    return "";
}

}  // namespace taylorcal::calibrate
