#pragma once

#include "emulator/inference/emulator.hpp"
#include "emulator/training/dataset.hpp"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::emulator {

/// Error of the best member in one output over rows of one category value.
struct OutputError {
    std::string output;
    std::string category;
    double rms = 0;  ///< In the output's own unit, as is `largest`.
    double largest = 0;
    /// Of outputs divided by their `divide_by`, over their mean magnitude in these rows
    /// (a value near zero must not count without bound).
    double rms_relative = 0;
    double largest_relative = 0;
    long n = 0;
};

/// The best member's answers for rows of a data set [rows x outputs], own units.
RowMatrix predict_rows(const Emulator& emulator, const Dataset& data,
                       const std::vector<Eigen::Index>& rows);

/// Errors by output and category value over the rows, in the model's order; those without
/// any value are left out.
std::vector<OutputError> errors_by_output(const Emulator& emulator, const Dataset& data,
                                          const std::vector<Eigen::Index>& rows,
                                          const RowMatrix& predicted);

/// RMS and largest relative error over everything (n-weighted RMS of the parts).
OutputError overall(const std::vector<OutputError>& parts);

/// A table for people and for scripts: comma-separated, percent for relative errors.
std::string error_table(const std::vector<OutputError>& errors);

nlohmann::json to_json(const OutputError& error);

}  // namespace taylorcal::emulator
