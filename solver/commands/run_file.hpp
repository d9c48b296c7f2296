#pragma once

#include "solver/impact/impact_result.hpp"

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::commands {

/// Writes one run as HDF5, schema taylorcal/run/1: `sizes`, `descriptors`, `history` and
/// `outline` with their `names` as attributes, `fields/<name>` with one entry a point.
void write_run_file(const std::filesystem::path& path, const impact::ImpactResult& result,
                    const nlohmann::json& description);

}  // namespace taylorcal::commands
