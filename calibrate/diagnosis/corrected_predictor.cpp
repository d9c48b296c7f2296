#include "calibrate/diagnosis/corrected_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taylorcal::calibrate {

CorrectedPredictor::CorrectedPredictor(const Predictor& network, const Settings& settings,
                                       const std::vector<Candidate>& candidates,
                                       std::map<std::string, ShapeSignature> shapes)
    : network_(network), settings_(settings), shapes_(std::move(shapes)) {
    for (const Candidate& candidate : candidates)
        typical_.push_back(std::abs(candidate.typical()));
}

RowMatrix CorrectedPredictor::predict(const Shot& shot,
                                      const RowMatrix& parameters) const {
    const ShapeSignature& shape = shapes_.at(shot.shape);
    RowMatrix sizes = network_.predict(shot, parameters);
    const RowMatrix raw = sizes;
    sizes.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < sizes.rows(); ++i) {
        const Eigen::VectorXd at = inputs(shot, parameters.row(i).transpose());
        const Eigen::VectorXd delta =
            shape.network_error(shape.terms(shape.network_error, at));
        for (std::size_t a = 0; a < shape.sizes.size(); ++a)
            sizes(i, shape.sizes[a]) =
                raw(i, shape.sizes[a]) +
                shot.initial_diameter_mm * delta(static_cast<Eigen::Index>(a));
    }
    return sizes;
}

RowMatrix CorrectedPredictor::shift(std::size_t k, const Shot& shot,
                                    const RowMatrix& parameters,
                                    const Eigen::VectorXd& amplitudes) const {
    const ShapeSignature& shape = shapes_.at(shot.shape);
    RowMatrix change = RowMatrix::Zero(
        parameters.rows(), *std::max_element(shape.sizes.begin(), shape.sizes.end()) + 1);
    if (!shape.effects[k]) return change;
    for (Eigen::Index i = 0; i < change.rows(); ++i) {
        const double amplitude = amplitudes(i) / typical_[k];
        const Eigen::VectorXd per_amplitude = (*shape.effects[k])(shape.terms(
            *shape.effects[k], inputs(shot, parameters.row(i).transpose()), amplitude));
        for (std::size_t a = 0; a < shape.sizes.size(); ++a)
            change(i, shape.sizes[a]) = shot.initial_diameter_mm * amplitude *
                                        per_amplitude(static_cast<Eigen::Index>(a));
    }
    return change;
}

Eigen::VectorXd CorrectedPredictor::velocity_slope(const Shot& shot,
                                                   const RowMatrix& parameters) const {
    Shot slower = shot, faster = shot;
    slower.velocity_m_s =
        std::max(0.99 * shot.velocity_m_s, network_.lowest_velocity_m_s());
    faster.velocity_m_s =
        std::min(1.01 * shot.velocity_m_s, network_.highest_velocity_m_s());
    const double step = faster.velocity_m_s - slower.velocity_m_s;
    const RowMatrix change = predict(faster, parameters) - predict(slower, parameters);
    if (!(step > 0)) return Eigen::VectorXd::Zero(change.cols());
    return change.row(0).transpose() / step;
}

std::string CorrectedPredictor::why_unseen(std::size_t k,
                                           const std::string& shape) const {
    if (shapes_.at(shape).effects[k]) return "";
    return "no signature runs with it for the shape " + shape;
}

}  // namespace taylorcal::calibrate
