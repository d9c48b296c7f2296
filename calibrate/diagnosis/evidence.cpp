#include "calibrate/diagnosis/evidence.hpp"

#include "calibrate/diagnosis/projector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace taylorcal::calibrate {
namespace {

constexpr int nodes_of_profile = 13;
constexpr double reach = 6;  // standard errors on either side of the best amplitude
constexpr Eigen::Index points_of_integral = 2001;

double log_det(const Eigen::MatrixXd& matrix) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    return 2 * cholesky.matrixLLT().diagonal().array().log().sum();
}

/// chi^2 at fixed amplitudes (equally spaced) with the parameters refitted at each, by
/// Gauss-Newton steps with the slopes of the best fit, all amplitudes in one batch.
Eigen::VectorXd profile(const DiagnosisProblem& problem, const Whitening& whiten,
                        const Refit& fit, const Eigen::VectorXd& amplitudes) {
    constexpr int turns = 4;
    const Eigen::Index p = fit.unit.size(), n = amplitudes.size();
    const Eigen::VectorXd measured = whiten(problem.measured);
    const Eigen::MatrixXd normal = fit.slope.transpose() * fit.slope;
    const Eigen::VectorXd lower = Eigen::VectorXd::Zero(p),
                          upper = Eigen::VectorXd::Ones(p);
    RowMatrix units = fit.unit.transpose().replicate(n, 1);
    Eigen::VectorXd lowest =
        Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
    for (int turn = 0; turn <= turns; ++turn) {
        const RowMatrix residuals =
            (-whitened_predictions(problem, whiten, fit.effects, units, amplitudes))
                .rowwise() +
            measured.transpose();
        lowest = lowest.cwiseMin(residuals.rowwise().squaredNorm());
        for (Eigen::Index i = 0; i < n; ++i)
            units.row(i) +=
                bounded_step(normal, fit.slope.transpose() * residuals.row(i).transpose(),
                             units.row(i).transpose(), lower, upper, 0)
                    .transpose();
    }
    return lowest;
}

/// Cubic through the four nearest of equally spaced nodes.
double interpolate(const Eigen::VectorXd& values, double place) {
    const auto first = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(place) - 1, 0,
                                                values.size() - 4);
    const double t = place - static_cast<double>(first);
    const double a = values(first), b = values(first + 1), c = values(first + 2),
                 d = values(first + 3);
    return -a * (t - 1) * (t - 2) * (t - 3) / 6 + b * t * (t - 2) * (t - 3) / 2 -
           c * t * (t - 1) * (t - 3) / 2 + d * t * (t - 1) * (t - 2) / 6;
}

/// The likelihood of an amplitude on a fine grid.
struct AmplitudeLikelihood {
    Eigen::VectorXd amplitude;
    Eigen::VectorXd log_likelihood;

    /// ln of the integral of prior x likelihood; fills the posterior's masses.
    double log_integral(const Candidate& candidate, const AmplitudePrior& prior,
                        Eigen::VectorXd& mass) const {
        const Eigen::Index n = amplitude.size();
        mass.resize(n);
        for (Eigen::Index i = 0; i < n; ++i)
            mass(i) = log_likelihood(i) + prior.log_density(amplitude(i));
        const double highest = mass.maxCoeff();
        if (!std::isfinite(highest)) return -std::numeric_limits<double>::infinity();
        mass = (mass.array() - highest).exp();
        mass(0) *= 0.5;
        mass(n - 1) *= 0.5;
        const double sum = mass.sum() * (amplitude(1) - amplitude(0));
        mass /= mass.sum();
        return highest + std::log(sum) -
               std::log(prior.mass(candidate.lower(), candidate.upper()));
    }
};

double quantile(const AmplitudeLikelihood& grid, const Eigen::VectorXd& mass,
                double share) {
    double sum = 0;
    for (Eigen::Index i = 0; i < mass.size(); ++i)
        if ((sum += mass(i)) >= share) return grid.amplitude(i);
    return grid.amplitude(mass.size() - 1);
}

AmplitudeLikelihood amplitude_likelihood(const DiagnosisProblem& problem,
                                         const Whitening& whiten, const Refit& fit,
                                         const Candidate& candidate) {
    const double typical = std::abs(candidate.typical());
    const double known = Projector(fit.slope)(fit.effect_slope).norm() / typical;
    const double half = known > 0 ? reach / known : candidate.highest - candidate.lowest;
    const double low = std::max(candidate.lower(), fit.amplitudes(0) - half);
    const double high = std::min(candidate.upper(), fit.amplitudes(0) + half);
    const Eigen::VectorXd nodes = Eigen::VectorXd::LinSpaced(nodes_of_profile, low, high);
    const Eigen::VectorXd chi2 = profile(problem, whiten, fit, nodes);
    const double at_best = log_average_likelihood(fit, whiten.log_determinant());
    AmplitudeLikelihood grid;
    grid.amplitude = Eigen::VectorXd::LinSpaced(points_of_integral, low, high);
    grid.log_likelihood.resize(points_of_integral);
    for (Eigen::Index i = 0; i < points_of_integral; ++i) {
        const double place = static_cast<double>(i * (nodes_of_profile - 1)) /
                             static_cast<double>(points_of_integral - 1);
        grid.log_likelihood(i) = at_best - 0.5 * (interpolate(chi2, place) - fit.chi2());
    }
    return grid;
}

}  // namespace

double log_average_likelihood(const Refit& fit, double log_determinant) {
    constexpr double of_prior = 2 * std::numbers::pi;
    Eigen::MatrixXd precision = fit.slope.transpose() * fit.slope;
    precision.diagonal().array() += of_prior;
    return -0.5 * (fit.chi2() + log_determinant + log_det(precision / of_prior));
}

Eigen::MatrixXd covariance_with(const DiagnosisProblem& problem,
                                const std::vector<std::size_t>& effects,
                                const Eigen::VectorXd& amplitudes) {
    Eigen::MatrixXd covariance = problem.covariance;
    for (std::size_t e = 0; e < effects.size(); ++e) {
        const Eigen::MatrixXd extra = problem.model.shift_covariance(effects[e]);
        const double amplitude = amplitudes(static_cast<Eigen::Index>(e));
        if (extra.size() > 0) covariance += amplitude * amplitude * extra;
    }
    return covariance;
}

double log_average_without(const DiagnosisProblem& problem, const Whitening& whiten,
                           const Refit& base) {
    const Refit without = refit(problem, whiten, {}, base.unit, Eigen::VectorXd());
    return log_average_likelihood(without, whiten.log_determinant());
}

Refit refit_with(const DiagnosisProblem& problem, std::optional<Whitening>& whiten,
                 const std::vector<std::size_t>& effects, const Refit& base) {
    Eigen::VectorXd start(static_cast<Eigen::Index>(effects.size()));
    for (std::size_t e = 0; e < effects.size(); ++e)
        start(static_cast<Eigen::Index>(e)) =
            0.1 * problem.candidates[effects[e]].typical();
    Refit fit = refit(problem, *whiten, effects, base.unit, start);
    bool has_errors = false;
    for (const std::size_t k : effects)
        has_errors = has_errors || problem.model.shift_covariance(k).size() > 0;
    if (!has_errors) return fit;
    whiten.emplace(covariance_with(problem, effects, fit.amplitudes));
    return refit(problem, *whiten, effects, fit.unit, fit.amplitudes);
}

EffectEvidence effect_evidence(const DiagnosisProblem& problem, const Whitening& whiten,
                               const Refit& base, std::size_t k) {
    const Candidate& candidate = problem.candidates[k];
    std::optional<Whitening> own = whiten;
    EffectEvidence found;
    found.fit = refit_with(problem, own, {k}, base);
    const AmplitudeLikelihood grid =
        amplitude_likelihood(problem, *own, found.fit, candidate);
    const double without = log_average_without(problem, *own, base);
    Eigen::VectorXd mass;
    const auto gain = [&](double factor) {
        return grid.log_integral(candidate, candidate.prior.widened(factor), mass) -
               without;
    };
    found.log_gain_half_width = gain(0.5);
    found.log_gain_double_width = gain(2);
    found.log_gain = gain(1);
    found.mean = mass.dot(grid.amplitude);
    found.sd =
        std::sqrt(mass.dot((grid.amplitude.array() - found.mean).square().matrix()));
    found.lower95 = quantile(grid, mass, 0.025);
    found.upper95 = quantile(grid, mass, 0.975);
    return found;
}

double pair_evidence(const DiagnosisProblem& problem, const Whitening& whiten,
                     const Refit& base, const Refit& fit) {
    constexpr Eigen::Index points = 241;
    const Candidate& first = problem.candidates[fit.effects[0]];
    const Candidate& second = problem.candidates[fit.effects[1]];
    const Eigen::Vector2d typical(std::abs(first.typical()), std::abs(second.typical()));
    const Projector project(fit.slope);
    const Eigen::MatrixXd slope =
        project(fit.effect_slope) * typical.cwiseInverse().asDiagonal();
    const Eigen::Matrix2d precision = slope.transpose() * slope;
    // Not zero where a bound of the range or of a parameter holds the fit back.
    const Eigen::Vector2d uphill = slope.transpose() * project(fit.residual);
    // Where the mass is, were the priors normal ones.
    Eigen::Matrix2d narrowed = precision;
    for (const auto& [c, e] : {std::pair{&first, 0}, std::pair{&second, 1}})
        narrowed(e, e) += 1 / std::pow(c->prior.scale, 2);
    const Eigen::Matrix2d covariance = narrowed.inverse();
    const Eigen::Vector2d mean = covariance * (precision * fit.amplitudes + uphill);
    const auto axis = [&](const Candidate& c, Eigen::Index e) {
        const double half = (reach + 2) * std::sqrt(covariance(e, e));
        return Eigen::VectorXd(Eigen::VectorXd::LinSpaced(
            points, std::max(c.lower(), std::min(mean(e), c.upper()) - half),
            std::min(c.upper(), std::max(mean(e), c.lower()) + half)));
    };
    const Eigen::VectorXd a = axis(first, 0), b = axis(second, 1);
    Eigen::MatrixXd log_mass(points, points);
    for (Eigen::Index i = 0; i < points; ++i)
        for (Eigen::Index j = 0; j < points; ++j) {
            const Eigen::Vector2d away = Eigen::Vector2d(a(i), b(j)) - fit.amplitudes;
            log_mass(i, j) = away.dot(uphill) - 0.5 * away.dot(precision * away) +
                             first.prior.log_density(a(i)) +
                             second.prior.log_density(b(j));
        }
    const double highest = log_mass.maxCoeff();
    const double cell = (a(1) - a(0)) * (b(1) - b(0));
    return log_average_likelihood(fit, whiten.log_determinant()) -
           log_average_without(problem, whiten, base) + highest +
           std::log((log_mass.array() - highest).exp().sum() * cell) -
           std::log(first.prior.mass(first.lower(), first.upper())) -
           std::log(second.prior.mass(second.lower(), second.upper()));
}

}  // namespace taylorcal::calibrate
