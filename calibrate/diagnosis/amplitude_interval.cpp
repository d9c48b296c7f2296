#include "calibrate/diagnosis/amplitude_interval.hpp"

#include "calibrate/diagnosis/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace taylorcal::calibrate {
namespace {

constexpr int spans_of_search = 12;
constexpr double precision = 0.01;  // of an end's distance from the best amplitude
constexpr int most_halvings = 24;   // where nothing but the best amplitude is allowed
constexpr double excluded = 3.841;  // chi^2 of one degree of freedom at 95 %

/// An amplitude with the parameters that fit it best.
struct Held {
    double amplitude;
    Eigen::VectorXd unit;
};

/// Refits the parameters of `held`; whether the likelihood ratio allows its amplitude.
bool is_allowed(const DiagnosisProblem& problem, const Refit& best, Held& held) {
    const Eigen::VectorXd amplitude = Eigen::VectorXd::Constant(1, held.amplitude);
    const Whitening whiten(covariance_with(problem, best.effects, amplitude));
    const auto height = [&](const Refit& fit) {
        return log_average_likelihood(fit, whiten.log_determinant());
    };
    const Refit fit =
        refit_parameters(problem, whiten, best.effects, held.unit, amplitude);
    held.unit = fit.unit;
    double highest = height(fit);
    for (const auto& [unit, start] :
         {std::pair{&fit.unit, &amplitude}, std::pair{&best.unit, &best.amplitudes}})
        highest = std::max(highest,
                           height(refit(problem, whiten, best.effects, *unit, *start)));
    return 2 * (highest - height(fit)) <= excluded;
}

/// From the best amplitude to `end` in equal spans, each from the parameters of the one
/// before; the outermost allowed one, and between it and its neighbour by halving.
double outermost(const DiagnosisProblem& problem, const Refit& best, double end) {
    const double start = best.amplitudes(0);
    if (end == start) return end;
    Held at{start, best.unit}, allowed = at;
    std::optional<Held> beyond;  // next to `allowed`
    for (int i = 1; i <= spans_of_search; ++i) {
        at.amplitude = start + (end - start) * i / spans_of_search;
        if (is_allowed(problem, best, at)) {
            allowed = at;
            beyond.reset();
        } else if (!beyond)
            beyond = at;
    }
    if (!beyond) return allowed.amplitude;
    const auto is_rough = [&] {
        return std::abs(beyond->amplitude - allowed.amplitude) >
               precision * std::abs(beyond->amplitude - start);
    };
    for (int i = 0; i < most_halvings && is_rough(); ++i) {
        at = {0.5 * (allowed.amplitude + beyond->amplitude), allowed.unit};
        (is_allowed(problem, best, at) ? allowed : *beyond) = at;
    }
    return allowed.amplitude;
}

}  // namespace

AmplitudeInterval amplitude_interval(const DiagnosisProblem& problem, const Refit& fit) {
    const RunRange range = range_of(problem, fit.effects[0]);
    return {outermost(problem, fit, range.lowest),
            outermost(problem, fit, range.highest)};
}

}  // namespace taylorcal::calibrate
