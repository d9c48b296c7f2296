#include "calibrate/diagnosis/leave_out.hpp"

#include "calibrate/measurements/velocity_thirds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace taylorcal::calibrate {
namespace {

double log_normal_density(const Eigen::VectorXd& deviation,
                          const Eigen::MatrixXd& covariance) {
    const Whitening whiten(covariance);
    return -0.5 *
           (whiten(deviation).squaredNorm() + whiten.log_determinant() +
            static_cast<double>(deviation.size()) * std::log(2 * std::numbers::pi));
}

/// Prior variance of an amplitude counted in typical ones.
double amplitude_variance(const Candidate& candidate) {
    const double scale = candidate.prior.scale / std::abs(candidate.typical());
    const double share =
        candidate.prior.kind == AmplitudePrior::Kind::uniform ? 1.0 / 3 : 1;
    return share * scale * scale;
}

}  // namespace

std::vector<std::size_t> groups_to_leave_out(const DiagnosisProblem& problem) {
    std::map<std::string, std::size_t> shapes;
    for (const ShotLabel& shot : problem.shots) shapes.emplace(shot.shape, shapes.size());
    const ThirdsOfVelocity thirds(problem.shots, &ShotLabel::velocity_m_s);
    std::vector<std::size_t> groups;
    for (const MeasuredNumber& datum : problem.data) {
        const ShotLabel& shot = problem.shots[datum.shot];
        groups.push_back(shapes.size() > 1 ? shapes.at(shot.shape)
                                           : thirds.index(shot.velocity_m_s));
    }
    return groups;
}

double leave_out_score(const DiagnosisProblem& problem, const Refit& fit,
                       const Eigen::MatrixXd& covariance,
                       const std::vector<std::size_t>& groups) {
    const Whitening whiten(covariance);
    const Eigen::Index p = fit.unit.size();
    const Eigen::MatrixXd slopes = whiten.colour(fit.all_slopes());
    Eigen::VectorXd variance = Eigen::VectorXd::Constant(slopes.cols(), 1.0 / 12);
    Eigen::VectorXd from_prior = Eigen::VectorXd::Zero(slopes.cols());
    from_prior.head(p) = fit.unit.array() - 0.5;
    for (std::size_t e = 0; e < fit.effects.size(); ++e) {
        const Candidate& candidate = problem.candidates[fit.effects[e]];
        const Eigen::Index at = p + static_cast<Eigen::Index>(e);
        variance(at) = amplitude_variance(candidate);
        from_prior(at) =
            fit.amplitudes(static_cast<Eigen::Index>(e)) / std::abs(candidate.typical());
    }
    const Eigen::VectorXd deviation =
        whiten.colour(fit.residual).col(0) + slopes * from_prior;
    const Eigen::MatrixXd whole =
        covariance + slopes * variance.asDiagonal() * slopes.transpose();
    const double all = log_normal_density(deviation, whole);
    double sum = 0;
    const std::size_t count = *std::max_element(groups.begin(), groups.end()) + 1;
    for (std::size_t g = 0; g < count; ++g) {
        std::vector<Eigen::Index> others;
        for (std::size_t i = 0; i < groups.size(); ++i)
            if (groups[i] != g) others.push_back(static_cast<Eigen::Index>(i));
        if (others.empty()) continue;
        sum += all - log_normal_density(deviation(others), whole(others, others));
    }
    return sum;
}

}  // namespace taylorcal::calibrate
