#pragma once

#include "emulator/inference/model.hpp"
#include "emulator/training/dataset.hpp"

#include <string>
#include <utility>
#include <vector>

namespace taylorcal::emulator {

/// Second moments of `errors` [rows x outputs] (NaN where there is no value) by category
/// value. A value with few held-out rows leans on all rows together: its moments count n
/// times, those of all 5 times. An output that a value has nowhere in `known`
/// [rows x outputs] is left out.
std::vector<std::pair<std::string, Covariance>> covariances(
    const RowMatrix& errors, const std::vector<std::string>& error_categories,
    const RowMatrix& known, const std::vector<std::string>& known_categories,
    const std::vector<std::string>& output_names);

}  // namespace taylorcal::emulator
