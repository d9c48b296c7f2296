#pragma once

#include "common/hdf5_file.hpp"
#include "emulator/inference/model.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taylorcal::emulator {

/// Rows to learn from: chosen columns of a database, in the units of the database.
struct Dataset {
    std::vector<std::int64_t> row_ids;
    RowMatrix inputs;                     ///< [rows x inputs]
    std::vector<std::string> categories;  ///< One a row; all "all" when there is none.
    std::vector<std::string> shapes;      ///< One a row, where the file has them.
    RowMatrix outputs;  ///< [rows x outputs], NaN where without meaning.
    /// By row, 1 for runs of a cheaper solver than the others; empty when all are of one.
    std::vector<float> cheaper;
    std::string file;       ///< Starts messages.
    long dropped_rows = 0;  ///< Not finished, or without any output.

    Eigen::Index rows() const { return inputs.rows(); }
};

/// The category value of every row when the data have no category.
inline constexpr const char* no_category = "all";

/// Reads columns by name; rows whose status is not 0 are dropped and counted. InputError
/// naming the file, the column and the row for what cannot be learnt from.
Dataset read_dataset(const std::filesystem::path& path,
                     const std::vector<std::string>& input_names,
                     const std::string& category,
                     const std::vector<std::string>& output_names);

/// The rows of `data`, which a cheaper solver made, and those of `better`. InputError
/// naming `where` when a run_id is in both.
Dataset with_better_runs(Dataset data, const Dataset& better, const std::string& where);

}  // namespace taylorcal::emulator
