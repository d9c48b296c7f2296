#pragma once

#include "calibrate/diagnosis/mode_diagnosis.hpp"

namespace taylorcal::calibrate {

/// Candidates within this of the best ln Z may not be told apart from it.
inline constexpr double indistinguishable = 3;
/// |cos| of two projected effects above which they are always reported together.
inline constexpr double alike = 0.9;

/// Evidence of every candidate that can be seen (threads).
void weigh_candidates(const DiagnosisProblem& problem, ModeDiagnosis& mode);

/// Finds which single candidates restore adequacy and marks the confusion set: those
/// within 3 of the best ln Z, and all that look alike with one of them. Empty if none.
void find_set(const DiagnosisProblem& problem, const NormalTable& table,
              ModeDiagnosis& mode);

/// All pairs of candidates, the most promising (linearised) refitted, best first.
void weigh_pairs(const DiagnosisProblem& problem, const NormalTable& table,
                 ModeDiagnosis& mode);

/// ln Z gained by the rival of all candidates: sizes that are off by a mean and a slope
/// in velocity of their own for every shape, whatever the cause.
double unlisted_gain(const DiagnosisProblem& problem, const ModeDiagnosis& mode);

}  // namespace taylorcal::calibrate
