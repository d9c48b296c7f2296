#pragma once

#include <string>

namespace taylorcal {

// Written by common/revision.cmake into the build folder at each build, and only there,
// so that a new commit recompiles one small file.

std::string project_version();
/// Newest commit that touched the programs' sources, "-modified" when they differ from
/// it.
std::string source_revision();
std::string compiler();

}  // namespace taylorcal
