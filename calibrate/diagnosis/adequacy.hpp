#pragma once

#include "calibrate/diagnosis/contrasts.hpp"
#include "calibrate/diagnosis/refit.hpp"

#include <algorithm>
#include <vector>

namespace taylorcal::calibrate {

/// How a candidate stands against the fitted model, all linearised there.
struct Screening {
    Eigen::VectorXd direction;   ///< whitened effect of amplitude 1, g
    Eigen::VectorXd projected;   ///< P g
    double identifiability = 0;  ///< eta = |P g| / |g|
    double score = 0;            ///< z = (P g)^T r / |P g|
    double amplitude = 0;        ///< of the least squares, z / |P g|
    bool is_screened = false;    ///< takes part in the score test
};

/// Below this share of survival "a change of parameters would look the same here".
inline constexpr double least_identifiability = 0.1;

/// Whether the model with its present effects explains the data within their errors.
struct Adequacy {
    Eigen::Index n = 0;
    Eigen::Index parameters = 0;  ///< directions that the data can bend
    double chi2 = 0;
    double p_chi2 = 1;
    std::vector<Contrast> battery;
    double p_battery = 1;
    double p_score = 1;
    double critical_score = 0;  ///< that would just be flagged
    std::vector<Contrast> drift;
    double p_drift = 1;
    std::vector<Screening> screening;  ///< of all candidates

    double smallest_p() const { return std::min({p_score, p_battery, p_chi2}); }
    /// Three tests share alpha. All are needed: the score finds what is in the list, the
    /// battery what is not, chi^2 what has no pattern.
    bool is_flagged(double alpha) const { return smallest_p() < alpha / 3; }
};

/// Tests a refit; candidates among `refit.effects` and unseen ones are not screened.
Adequacy test_adequacy(const DiagnosisProblem& problem, const Whitening& whiten,
                       const Refit& refit, const NormalTable& table);

/// Most statistics that any test of the problem has, for the table of normal numbers.
Eigen::Index most_statistics(const DiagnosisProblem& problem);

}  // namespace taylorcal::calibrate
