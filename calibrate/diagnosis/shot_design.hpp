#pragma once

#include "calibrate/diagnosis/diagnosis_study.hpp"

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// The shots, within what the signatures cover, that best tell apart the explanations of
/// `names` (candidates; "" is the model without any). With one explanation its strongest
/// rival joins; with none, the least visible effect at its smallest detectable amplitude
/// is set against the model without it. Best first, at most `count`, one a shape and
/// velocity step.
std::vector<NextExperiment> design_shots(const DiagnosisStudy& study,
                                         const DiagnosisProblem& problem,
                                         const ModeDiagnosis& mode,
                                         const std::vector<std::size_t>& set,
                                         std::size_t count);

}  // namespace taylorcal::calibrate
