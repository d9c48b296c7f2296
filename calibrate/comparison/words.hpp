#pragma once

#include <string>

namespace taylorcal::calibrate {

struct ResidualGroup;

/// "final length" of "final_length_mm".
std::string size_in_words(const std::string& size);

/// What the per cent of a size's deviations are of, where it is not the size itself:
/// " of L0" of the undeformed length, which may vanish, " of D0" of an outline's scores.
std::string reference_in_words(const std::string& size);

/// "4-mm head" of "reduced_head_4mm".
std::string shape_in_words(const std::string& shape);

/// What a group's residuals say, e.g. "final length predicted 3.1 % too short at high
/// velocity (12 values, rms 4.2 standard errors)". A direction is named when the mean
/// lies beyond 2.5 of its own standard errors, and only for groups of one size.
std::string group_words(const ResidualGroup& group);

}  // namespace taylorcal::calibrate
