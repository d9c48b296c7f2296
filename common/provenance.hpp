#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal {

/// What every output records: program, version, source revision, compiler, processor,
/// variant of the hot loops, seed and configuration (whole, and its SHA-256). No dates:
/// same inputs, same bytes.
nlohmann::json provenance(const std::string& program, std::uint64_t seed,
                          const nlohmann::json& configuration);

/// Project version and source revision, e.g. "0.1.0 (3f2a91c)".
std::string version();

}  // namespace taylorcal
