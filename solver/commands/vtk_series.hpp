#pragma once

#include "solver/impact/impact_result.hpp"

#include <filesystem>
#include <vector>

namespace taylorcal::commands {

/// Writes `folder`/snapshot_0000.vtkhdf and so on (VTKHDF, unstructured grid: particles
/// as vertices, cells of (r, z) as quadrilaterals in the plane y = 0), and
/// `folder`/snapshots.vtkhdf.series, which ParaView opens with the times [us]. Positions
/// in mm.
void write_vtk_series(const std::filesystem::path& folder,
                      const std::vector<impact::Fields>& snapshots);

}  // namespace taylorcal::commands
