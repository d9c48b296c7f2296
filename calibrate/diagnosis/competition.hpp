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

/// ln Z by which two effects must beat the best one: two at once are rarer.
inline constexpr double worth_a_second = 5;

/// Pairs that explain, within reach of the best of them, which comes first.
std::vector<const PairRecord*> explaining_pairs(const ModeDiagnosis& mode);

/// Where several pairs explain and no candidate alone does: the one that all of them
/// share, with what looks like it, if a second adds too little to its ln Z to be worth
/// naming. Else nothing.
std::vector<std::size_t> enough_alone(const ModeDiagnosis& mode,
                                      const std::vector<const PairRecord*>& pairs);

/// ln Z gained by the rival of all candidates: sizes that are off by a mean, a slope
/// and a curvature in velocity of their own for every shape, whatever the cause.
double unlisted_gain(const DiagnosisProblem& problem, const ModeDiagnosis& mode);

}  // namespace taylorcal::calibrate
