#pragma once

#include "calibrate/diagnosis/diagnosis_study.hpp"

#include <vector>

namespace taylorcal::calibrate {

/// The shots, within what the signatures cover, that best tell apart the candidates of
/// `set`, at most `count`, best first. One candidate is set against its strongest rival;
/// none: the least visible one at its smallest detectable amplitude against the model
/// without it. Shots are of the metal of the lot with most fitted shots, of several the
/// first by name: its parameters make the predictions.
std::vector<NextExperiment> design_shots(const DiagnosisStudy& study,
                                         const DiagnosisProblem& problem,
                                         const ModeDiagnosis& mode,
                                         const std::vector<std::size_t>& set,
                                         std::size_t count);

}  // namespace taylorcal::calibrate
