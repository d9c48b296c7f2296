#pragma once

#include "solver/impact/impact_result.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::commands {

/// What is kept of one run of a batch. Figures that are not finite are NaN, so that a row
/// read back from the journal is the row that was written.
struct FinishedRun {
    std::int64_t run_id = 0;
    impact::Status status = impact::Status::failed;
    std::string reason;
    std::vector<double> outputs;      ///< observe::size_names()
    std::vector<double> descriptors;  ///< impact::descriptor_names()
    /// observe::sample_outline, NaN in a failed run; empty in a row of a database that
    /// was made before outlines were kept.
    std::vector<double> outline_radius;
    std::int64_t steps = 0;
    std::int64_t grain_updates = 0;
    double cpu_s = 0;
};

/// The row of a run that answered.
FinishedRun row_of(std::int64_t run_id, const impact::ImpactResult& result);

/// The row of a run that threw: all figures NaN.
FinishedRun failed_row(std::int64_t run_id, const std::string& reason);

nlohmann::json to_json(const FinishedRun& run);
/// Throws nlohmann::json::exception or InputError when `line` is not such a row.
FinishedRun run_from_json(const nlohmann::json& line);

}  // namespace taylorcal::commands
