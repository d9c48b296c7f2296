#pragma once

#include "calibrate/diagnosis/refit.hpp"

namespace taylorcal::calibrate {

struct AmplitudeInterval {
    double lower95, upper95;
};

/// The amplitudes of one candidate that the data do not exclude, from the lowest to the
/// highest within its paired runs: twice the ln of the likelihood ratio of the best
/// amplitude to the one in question is at most 3.84. Both are refitted and averaged over
/// the parameters under the errors of the signature at the one in question: what is known
/// badly excludes little, and wider errors do not count against it. `fit`: the best place
/// of candidate `fit.effects[0]`.
AmplitudeInterval amplitude_interval(const DiagnosisProblem& problem, const Refit& fit);

}  // namespace taylorcal::calibrate
