#include "common/provenance.hpp"

#include "common/revision.hpp"
#include "common/sha256.hpp"
#include "common/simd.hpp"

#include <fstream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal {

namespace {

std::string processor() {
    std::ifstream information("/proc/cpuinfo");
    for (std::string line; std::getline(information, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

}  // namespace

nlohmann::json provenance(const std::string& program, std::uint64_t seed,
                          const nlohmann::json& configuration) {
    return {{"program", program},
            {"version", project_version()},
            {"revision", source_revision()},
            {"compiler", compiler()},
            {"processor", processor()},
            {"simd", simd::name(simd::variant())},
            {"seed", seed},
            {"configuration", configuration},
            {"configuration_digest", sha256(configuration.dump())}};
}

std::string version() {
    return fmt::format("{} ({})", project_version(), source_revision());
}

}  // namespace taylorcal
