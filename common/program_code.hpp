#pragma once

#include "common/provenance.hpp"

#include <string>

namespace taylorcal {

/// Digest of the sources that the running program was made of, as 16 hexadecimal digits:
/// the same wherever and whenever it was built. Defined in a library of each program's
/// own, which common/program_code.cmake writes.
std::string program_code();

/// What `--version` says, e.g. "solver 0.1.0 (3f2a91c), code fdb35cfd0e508a3d".
inline std::string version_words(const std::string& program) {
    return program + " " + version() + ", code " + program_code();
}

}  // namespace taylorcal
