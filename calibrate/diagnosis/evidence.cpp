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

constexpr int nodes_of_profile = 25;
constexpr double reach = 6;       // standard errors on either side of the best amplitude
constexpr double far_below = 18;  // in ln L: six standard errors of a normal one
constexpr Eigen::Index points_of_integral = 2001;

double log_det(const Eigen::MatrixXd& matrix) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    return 2 * cholesky.matrixLLT().diagonal().array().log().sum();
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

    /// ln of the integral of prior x likelihood.
    double log_integral(const Candidate& candidate, const AmplitudePrior& prior) const {
        Eigen::VectorXd log_mass = log_likelihood;
        for (Eigen::Index i = 0; i < log_mass.size(); ++i)
            log_mass(i) += prior.log_density(amplitude(i));
        const double highest = log_mass.maxCoeff();
        if (!std::isfinite(highest)) return -std::numeric_limits<double>::infinity();
        return highest +
               std::log(masses(log_mass).sum() * (amplitude(1) - amplitude(0))) -
               std::log(prior.mass(candidate.lower(), candidate.upper()));
    }
    /// By the trapezium rule, the largest density as 1.
    static Eigen::VectorXd masses(const Eigen::VectorXd& log_density) {
        Eigen::VectorXd mass = (log_density.array() - log_density.maxCoeff()).exp();
        mass(0) *= 0.5;
        mass(mass.size() - 1) *= 0.5;
        return mass;
    }
};

double quantile(const AmplitudeLikelihood& grid, const Eigen::VectorXd& mass,
                double share) {
    double sum = 0;
    for (Eigen::Index i = 0; i < mass.size(); ++i)
        if ((sum += mass(i)) >= share) return grid.amplitude(i);
    return grid.amplitude(mass.size() - 1);
}

/// ln of the likelihood averaged over the parameters at one amplitude of one candidate.
double log_average_at(const DiagnosisProblem& problem, const Whitening& whiten,
                      const Refit& from, double amplitude) {
    const Eigen::VectorXd held = Eigen::VectorXd::Constant(1, amplitude);
    const Refit fit = refit_parameters(problem, whiten, from.effects, from.unit, held);
    return log_average_likelihood(fit, whiten.log_determinant());
}

/// Where the likelihood of an amplitude has fallen far below its best, on one side
/// (`side` = -1 or 1). Six standard errors are not enough where parameters follow the
/// amplitude along a curved ridge.
double far_end(const DiagnosisProblem& problem, const Whitening& whiten, const Refit& fit,
               double half, double bound, double side) {
    const double best = log_average_likelihood(fit, whiten.log_determinant());
    for (;; half *= 2) {
        const double end = fit.amplitudes(0) + side * half;
        if (side * (end - bound) >= 0) return bound;
        if (log_average_at(problem, whiten, fit, end) < best - far_below) return end;
    }
}

AmplitudeLikelihood amplitude_likelihood(const DiagnosisProblem& problem,
                                         const Whitening& whiten, const Refit& fit,
                                         const Candidate& candidate) {
    const double typical = std::abs(candidate.typical());
    const double known = Projector(fit.slope)(fit.effect_slope).norm() / typical;
    const double half = known > 0 ? reach / known : candidate.highest - candidate.lowest;
    const double low = far_end(problem, whiten, fit, half, candidate.lower(), -1);
    const double high = far_end(problem, whiten, fit, half, candidate.upper(), 1);
    const Eigen::VectorXd nodes = Eigen::VectorXd::LinSpaced(nodes_of_profile, low, high);
    Eigen::VectorXd at_nodes(nodes_of_profile);
    for (Eigen::Index i = 0; i < nodes_of_profile; ++i)
        at_nodes(i) = log_average_at(problem, whiten, fit, nodes(i));
    // A fall without bottom, where a parameter has reached its own bound, would make a
    // cubic swing.
    at_nodes = at_nodes.cwiseMax(at_nodes.maxCoeff() - 2 * far_below);
    AmplitudeLikelihood grid;
    grid.amplitude = Eigen::VectorXd::LinSpaced(points_of_integral, low, high);
    grid.log_likelihood.resize(points_of_integral);
    for (Eigen::Index i = 0; i < points_of_integral; ++i) {
        const double place = static_cast<double>(i * (nodes_of_profile - 1)) /
                             static_cast<double>(points_of_integral - 1);
        grid.log_likelihood(i) = interpolate(at_nodes, place);
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
    const auto gain = [&](double factor) {
        return grid.log_integral(candidate, candidate.prior.widened(factor)) - without;
    };
    found.log_gain_half_width = gain(0.5);
    found.log_gain_double_width = gain(2);
    found.log_gain = gain(1);
    Eigen::VectorXd mass = AmplitudeLikelihood::masses(grid.log_likelihood);
    mass /= mass.sum();
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
