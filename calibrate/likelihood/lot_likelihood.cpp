#include "calibrate/likelihood/lot_likelihood.hpp"

#include "calibrate/likelihood/common_error.hpp"
#include "calibrate/likelihood/errors_of_shot.hpp"

namespace taylorcal::calibrate {

LotLikelihood::LotLikelihood(const Settings& settings, const DataSet& set,
                             const ParameterSpace& space, const Predictor& predictor,
                             const Eigen::VectorXd& reference)
    : space_(space),
      predictor_(predictor),
      levels_(spread_levels(settings)),
      reference_(reference),
      lots_(set.lots.size()),
      blocks_(set.lots.size()) {
    std::vector<std::vector<const Datum*>> shots(set.lots.size());
    for (const Datum* datum : set.fitted()) shots[datum->lot].push_back(datum);
    for (std::size_t lot = 0; lot < shots.size(); ++lot) {
        shots_ += shots[lot].size();
        if (shots[lot].empty()) continue;
        const RowMatrix point = space.lot_parameters(reference.transpose(), lot);
        const Eigen::VectorXd parameters = point.row(0).transpose();
        if (settings.network_errors == NetworkErrors::common) {
            blocks_[lot].emplace(
                shots[lot], lot_covariance(settings, predictor, shots[lot], parameters),
                levels_);
            continue;
        }
        for (const Datum* datum : shots[lot])
            lots_[lot].push_back(
                {datum->shot,
                 ShotLikelihood(*datum,
                                fixed_covariance(settings, predictor, *datum, parameters),
                                levels_)});
    }
}

RowMatrix LotLikelihood::operator()(std::size_t lot, const RowMatrix& parameters) const {
    if (blocks_[lot]) return (*blocks_[lot])(predictor_, parameters);
    RowMatrix total = RowMatrix::Zero(parameters.rows(),
                                      static_cast<Eigen::Index>(levels_.values.size()));
    for (const Row& part : lots_[lot]) {
        const RowMatrix predicted = predictor_.predict(part.shot, parameters);
        for (Eigen::Index i = 0; i < parameters.rows(); ++i)
            part.likelihood.add(predicted.row(i), &total(i, 0));
    }
    return total;
}

RowMatrix LotLikelihood::whitened(const RowMatrix& units, std::size_t level) const {
    std::vector<Eigen::VectorXd> columns;
    for (std::size_t lot = 0; lot < lots_.size(); ++lot) {
        const RowMatrix parameters = space_.lot_parameters(units, lot);
        if (blocks_[lot]) {
            const RowMatrix own = blocks_[lot]->whitened(predictor_, parameters, level);
            for (const auto& column : own.colwise()) columns.emplace_back(column);
            continue;
        }
        for (const Row& part : lots_[lot]) {
            const RowMatrix predicted = predictor_.predict(part.shot, parameters);
            const std::size_t first = columns.size();
            columns.resize(first + part.likelihood.size(), Eigen::VectorXd(units.rows()));
            for (Eigen::Index i = 0; i < units.rows(); ++i) {
                const Eigen::VectorXd r =
                    part.likelihood.whitened(predicted.row(i).transpose(), level);
                for (std::size_t c = first; c < columns.size(); ++c)
                    columns[c](i) = r(static_cast<Eigen::Index>(c - first));
            }
        }
    }
    RowMatrix all(units.rows(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c)
        all.col(static_cast<Eigen::Index>(c)) = columns[c];
    return all;
}

RowMatrix LotLikelihood::log_likelihood(const RowMatrix& units) const {
    RowMatrix total =
        RowMatrix::Zero(units.rows(), static_cast<Eigen::Index>(levels_.values.size()));
    for (std::size_t lot = 0; lot < lots_.size(); ++lot)
        total += (*this)(lot, space_.lot_parameters(units, lot));
    return total;
}

}  // namespace taylorcal::calibrate
