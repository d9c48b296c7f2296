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
    double p_bad_data = 1;      ///< of the wildest shot or number
    double critical_score = 0;  ///< that would just be flagged
    std::vector<Contrast> drift;
    double p_drift = 1;
    std::vector<Screening> screening;  ///< of all candidates

    double smallest_p() const {
        return std::min({p_score, p_battery, p_chi2, p_bad_data});
    }
    /// Four tests share alpha. All are needed: the score finds what is in the list, the
    /// battery what is not, chi^2 what has no pattern, the last a single wrong number.
    static double level_of_test(double alpha) { return alpha / 4; }
    bool is_flagged(double alpha) const { return smallest_p() < level_of_test(alpha); }
};

/// An explanation fails when what it leaves would be flagged at this level. Stricter than
/// alpha: one in twenty true explanations must not be thrown away.
inline constexpr double alpha_of_rest = 0.01;

/// Tests a refit; candidates among `refit.effects` and unseen ones are not screened.
Adequacy test_adequacy(const DiagnosisProblem& problem, const Whitening& whiten,
                       const Refit& refit, const NormalTable& table);

/// Most statistics that any test of the problem has, for the table of normal numbers.
Eigen::Index most_statistics(const DiagnosisProblem& problem);

}  // namespace taylorcal::calibrate
