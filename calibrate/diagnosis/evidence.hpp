#pragma once

#include "calibrate/diagnosis/amplitude_interval.hpp"
#include "calibrate/diagnosis/refit.hpp"

#include <optional>

namespace taylorcal::calibrate {

/// One candidate switched on: best fit, evidence and amplitude.
struct EffectEvidence {
    Refit fit;
    double log_gain = 0;  ///< ln Z_k - ln Z_0
    double log_gain_half_width = 0;
    double log_gain_double_width = 0;
    /// Of the amplitude by the data alone: every value of its physical range is as likely
    /// before. A prior's scale is a judgement, and would pull strong effects down.
    double mean = 0;
    double sd = 0;
    AmplitudeInterval interval{};
    /// Whether the fit is held where its paired runs end, short of the ranges.
    bool is_at_end_of_runs = false;
};

/// ln of the likelihood averaged over the parameters about a fit, by Laplace's
/// approximation, but for constants that all fits of a problem share. A parameter that
/// the data do not feel counts with its prior's width.
double log_average_likelihood(const Refit& fit, double log_determinant);

/// The same without any candidate, refitted from `base` and from the parameters of `fit`
/// with the candidate: the higher one, for a better start is no evidence. Under the
/// errors of a candidate's signature, for the evidence of one must not come from wider
/// errors.
double log_average_without(const DiagnosisProblem& problem, const Whitening& whiten,
                           const Refit& base, const Refit& fit);

/// C with the errors of the effects' signatures at their amplitudes.
Eigen::MatrixXd covariance_with(const DiagnosisProblem& problem,
                                const std::vector<std::size_t>& effects,
                                const Eigen::VectorXd& amplitudes);

/// Refits parameters and amplitudes together, from `unit` and `amplitudes`; where
/// signatures have errors, once more with the errors at that amplitude in `whiten`.
Refit refit_from(const DiagnosisProblem& problem, std::optional<Whitening>& whiten,
                 const std::vector<std::size_t>& effects, const Eigen::VectorXd& unit,
                 const Eigen::VectorXd& amplitudes);

/// The same from a fit without the effects.
Refit refit_with(const DiagnosisProblem& problem, std::optional<Whitening>& whiten,
                 const std::vector<std::size_t>& effects, const Refit& base);

/// ln Z_k - ln Z_0, both with the errors of its signature, by integrating over the
/// amplitude the likelihood that is, at each of its values, refitted and averaged over
/// the parameters; with the candidate's prior, cut to its physical range.
EffectEvidence effect_evidence(const DiagnosisProblem& problem, const Whitening& whiten,
                               const Refit& base, std::size_t k);

/// The same for two candidates at once: the likelihood quadratic about the fit, the
/// priors as they are, integrated over both amplitudes. `whiten`: as `refit_with` left
/// it.
double pair_evidence(const DiagnosisProblem& problem, const Whitening& whiten,
                     const Refit& base, const Refit& fit);

}  // namespace taylorcal::calibrate
