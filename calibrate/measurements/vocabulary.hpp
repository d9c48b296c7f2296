#pragma once

#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// Words that a measurement table may hold.
const std::vector<std::string>& shape_words();
const std::vector<std::string>& use_words();
/// Columns of measured sizes; each has a companion "<size>_sd".
const std::vector<std::string>& size_columns();
/// Columns that every table must have.
const std::vector<std::string>& required_columns();
/// Every column a table may have.
const std::vector<std::string>& known_columns();

}  // namespace taylorcal::calibrate
