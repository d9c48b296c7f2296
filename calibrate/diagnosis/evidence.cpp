#include "calibrate/diagnosis/evidence.hpp"

#include "calibrate/diagnosis/amplitude_profile.hpp"
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

constexpr double reach = 8;  // standard errors of a pair's amplitudes
constexpr Eigen::Index points_of_integral = 2001;

double log_det(const Eigen::MatrixXd& matrix) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    return 2 * cholesky.matrixLLT().diagonal().array().log().sum();
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

AmplitudeLikelihood on_fine_grid(const AmplitudeProfile& profile) {
    AmplitudeLikelihood grid;
    grid.amplitude = profile.amplitudes(points_of_integral);
    grid.log_likelihood = grid.amplitude.unaryExpr(profile);
    return grid;
}

bool is_at_end_of_runs(const DiagnosisProblem& problem, const Refit& fit) {
    const Candidate& candidate = problem.candidates[fit.effects[0]];
    const RunRange range = range_of(problem, fit.effects[0]);
    const double amplitude = fit.amplitudes(0);
    const auto holds = [](double value, double low, double high, double least,
                          double most) {
        const double near = 1e-6 * (high - low);
        return (value <= low + near && low > least) ||
               (value >= high - near && high < most);
    };
    if (holds(amplitude, range.lowest, range.highest, candidate.lower(),
              candidate.upper()))
        return true;
    for (Eigen::Index j = 0; j < fit.unit.size(); ++j)
        if (holds(fit.unit(j), range.lower(j), range.upper(j), 0, 1)) return true;
    return false;
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
                           const Refit& base, const Refit& fit) {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Eigen::VectorXd& start : {base.unit, fit.unit}) {
        const Refit without = refit(problem, whiten, {}, start, Eigen::VectorXd());
        highest =
            std::max(highest, log_average_likelihood(without, whiten.log_determinant()));
    }
    return highest;
}

Refit refit_from(const DiagnosisProblem& problem, std::optional<Whitening>& whiten,
                 const std::vector<std::size_t>& effects, const Eigen::VectorXd& unit,
                 const Eigen::VectorXd& amplitudes) {
    Refit fit = refit(problem, *whiten, effects, unit, amplitudes);
    bool has_errors = false;
    for (const std::size_t k : effects)
        has_errors = has_errors || problem.model.shift_covariance(k).size() > 0;
    if (!has_errors) return fit;
    whiten.emplace(covariance_with(problem, effects, fit.amplitudes));
    return refit(problem, *whiten, effects, fit.unit, fit.amplitudes);
}

Refit refit_with(const DiagnosisProblem& problem, std::optional<Whitening>& whiten,
                 const std::vector<std::size_t>& effects, const Refit& base) {
    Eigen::VectorXd start(static_cast<Eigen::Index>(effects.size()));
    for (std::size_t e = 0; e < effects.size(); ++e)
        start(static_cast<Eigen::Index>(e)) =
            0.1 * problem.candidates[effects[e]].typical();
    return refit_from(problem, whiten, effects, base.unit, start);
}

EffectEvidence effect_evidence(const DiagnosisProblem& problem, const Whitening& whiten,
                               const Refit& base, std::size_t k) {
    const Candidate& candidate = problem.candidates[k];
    std::optional<Whitening> own = whiten;
    Refit near = refit_with(problem, own, {k}, base);
    const AmplitudeProfile profile(problem, base, {std::move(near), std::move(*own)});
    const AmplitudeLikelihood grid = on_fine_grid(profile);
    EffectEvidence found;
    found.fit = profile.best().fit;
    const double without =
        log_average_without(problem, profile.best().whiten, base, found.fit);
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
    found.interval = amplitude_interval(problem, found.fit);
    found.is_at_end_of_runs = is_at_end_of_runs(problem, found.fit);
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
        const double half = reach * std::sqrt(covariance(e, e));
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
           log_average_without(problem, whiten, base, fit) + highest +
           std::log((log_mass.array() - highest).exp().sum() * cell) -
           std::log(first.prior.mass(first.lower(), first.upper())) -
           std::log(second.prior.mass(second.lower(), second.upper()));
}

}  // namespace taylorcal::calibrate
