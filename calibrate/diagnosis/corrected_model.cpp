#include "calibrate/diagnosis/corrected_model.hpp"

#include "calibrate/diagnosis/error_budget.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace taylorcal::calibrate {
namespace {

/// Of a range that runs span: as far as the polynomials go.
constexpr double beyond_range = 0.5 * (extrapolated - 1);
/// Of a parameter's prior: where data pin a parameter the runs span next to nothing, but
/// an effect may move it.
constexpr double least_beyond = 0.1;

std::set<std::string> shapes_of(const std::vector<const Datum*>& data) {
    std::set<std::string> shapes;
    for (const Datum* datum : data) shapes.insert(datum->shot.shape);
    return shapes;
}

}  // namespace

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

/// Of the parameter behind a unit coordinate, in the order of the configuration.
Eigen::Index CorrectedModel::position_of(Eigen::Index coordinate) const {
    const std::vector<Parameter>& all = space_.parameters();
    const std::string& name = space_.parameter(static_cast<std::size_t>(coordinate)).name;
    return std::find_if(all.begin(), all.end(),
                        [&](const Parameter& p) { return p.name == name; }) -
           all.begin();
}

Eigen::VectorXd CorrectedModel::reference_of(const Datum& datum) const {
    return space_.lot_parameters(reference_.transpose(), datum.lot).row(0).transpose();
}

Eigen::MatrixXd CorrectedModel::shift_covariance(std::size_t k) const {
    return effect_errors(predictor_, *this, k);
}

RunRange CorrectedModel::run_range(std::size_t k) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    const auto n = static_cast<Eigen::Index>(space_.size());
    RunRange range{0, 0, Eigen::VectorXd::Constant(n, none),
                   Eigen::VectorXd::Constant(n, -none)};
    for (const std::string& shape : shapes_of(data_)) {
        const ShapeSignature& signature = predictor_.signature(shape);
        range.lowest = std::min(range.lowest, signature.amplitudes[k].first);
        range.highest = std::max(range.highest, signature.amplitudes[k].second);
        for (Eigen::Index i = 0; i < n; ++i)
            for (const double value : signature.parameters.col(position_of(i))) {
                const double unit = space_.unit(static_cast<std::size_t>(i), value);
                range.lower(i) = std::min(range.lower(i), unit);
                range.upper(i) = std::max(range.upper(i), unit);
            }
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const double width = range.upper(i) - range.lower(i);
        const bool varies = width > 1e-6;
        const double beyond = std::max(beyond_range * width, least_beyond);
        range.lower(i) = varies ? std::max(range.lower(i) - beyond, 0.0) : 0;
        range.upper(i) = varies ? std::min(range.upper(i) + beyond, 1.0) : 1;
    }
    const double further = beyond_range * (range.highest - range.lowest);
    range.lowest -= further;
    range.highest += further;
    return range;
}

std::string CorrectedModel::why_unseen(std::size_t k) const {
    for (const std::string& shape : shapes_of(data_))
        if (const std::string why = predictor_.why_unseen(k, shape); !why.empty())
            return why;
    return "";
}

}  // namespace taylorcal::calibrate
