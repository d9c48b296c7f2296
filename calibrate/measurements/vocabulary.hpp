#pragma once

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// Words that a measurement table may hold.
const std::vector<std::string>& use_words();
/// Columns of measured sizes; each has a companion "<size>_sd".
const std::vector<std::string>& size_columns();
/// Whether a size is a score of the outline's principal components ("outline_pc_1"), a
/// radius [mm] that may have either sign.
bool is_outline_score(const std::string& size);
/// Columns that every table must have.
const std::vector<std::string>& required_columns();
/// Every column a table may have.
const std::vector<std::string>& known_columns();

}  // namespace taylorcal::calibrate
