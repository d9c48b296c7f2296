#include "calibrate/comparison/joint_errors.hpp"

#include "calibrate/likelihood/common_error.hpp"

#include <Eigen/Cholesky>

namespace taylorcal::calibrate {
namespace {

/// Sizes of one shot among those of all.
struct Segment {
    const ShotComparison* shot;
    Eigen::Index start;

    Eigen::Index size() const { return shot->residual.size(); }
};

/// Writes what the shots of one lot have in common beside the diagonal [mm^2].
void add_common_errors(const ComparisonInputs& inputs,
                       const std::vector<Segment>& segments, std::size_t lot,
                       Eigen::MatrixXd& covariance) {
    std::vector<const Datum*> data;
    std::vector<Segment> own;
    for (const Segment& segment : segments)
        if (segment.shot->datum->lot == lot) {
            data.push_back(segment.shot->datum);
            own.push_back(segment);
        }
    const Eigen::VectorXd parameters =
        inputs.space.lot_parameters(inputs.posterior.reference.transpose(), lot)
            .row(0)
            .transpose();
    const Eigen::MatrixXd common =
        lot_covariance(inputs.settings, inputs.predictor, data, parameters);
    Eigen::Index row = 0;
    for (const Segment& a : own) {
        Eigen::Index column = 0;
        for (const Segment& b : own) {
            if (a.start != b.start)
                covariance.block(a.start, b.start, a.size(), b.size()) =
                    common.block(row, column, a.size(), b.size());
            column += b.size();
        }
        row += a.size();
    }
}

}  // namespace

JointErrors joint_errors(const ComparisonInputs& inputs,
                         const std::vector<ShotComparison>& shots) {
    std::vector<Segment> segments;
    Eigen::Index n = 0;
    for (const ShotComparison& shot : shots) {
        segments.push_back({&shot, n});
        n += shot.residual.size();
    }
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd inverse_roots = covariance;
    for (const Segment& segment : segments) {
        const Eigen::MatrixXd& own = segment.shot->covariance;
        covariance.block(segment.start, segment.start, own.rows(), own.rows()) = own;
        inverse_roots.block(segment.start, segment.start, own.rows(), own.rows()) =
            Eigen::LLT<Eigen::MatrixXd>(own).matrixL().solve(
                Eigen::MatrixXd::Identity(own.rows(), own.rows()));
    }
    if (inputs.settings.network_errors == NetworkErrors::common)
        for (std::size_t lot = 0; lot < inputs.set.lots.size(); ++lot)
            add_common_errors(inputs, segments, lot, covariance);
    const Eigen::VectorXd inverse_sd = covariance.diagonal().cwiseSqrt().cwiseInverse();
    return {inverse_sd.asDiagonal() * covariance * inverse_sd.asDiagonal(),
            inverse_roots * covariance * inverse_roots.transpose()};
}

}  // namespace taylorcal::calibrate
