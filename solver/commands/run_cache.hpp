#pragma once

#include "solver/commands/configuration.hpp"
#include "solver/commands/design.hpp"
#include "solver/commands/finished_run.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taylorcal::commands {

/// All that a run's figures follow from, as text: shape, shot, seed, material, effects
/// and numerics, whichever of design and configuration set them, the solver's sources and
/// the SIMD variant. An effect of amplitude 0 and a constant at its default leave no
/// trace.
std::string run_question(const Design& design, std::size_t row,
                         const Configuration& configuration);

/// Finished runs in a folder that studies and users share, one small file a run in
/// `<folder>/<two digits>/<SHA-256 of its question>.json`. An entry is written whole or
/// not at all; one that is damaged counts as missing and is written anew.
class RunCache {
  public:
    /// No cache.
    RunCache() = default;
    /// The cache as the rows of a design use it; none if `folder` is empty. InputError
    /// when the folder cannot be made.
    RunCache(std::filesystem::path folder, const Design& design,
             const Configuration& configuration);

    /// The finished run of a row.
    std::optional<FinishedRun> found(std::size_t row) const;
    /// Keeps the run of a row, unless it failed or met the limit on processor time, which
    /// depends on the machine. What cannot be written is warned of once.
    void keep(std::size_t row, const FinishedRun& run);

  private:
    std::filesystem::path place(const std::string& question) const;
    std::filesystem::path folder_;
    std::vector<std::string> questions_;
    std::vector<std::int64_t> run_ids_;
    bool warned_ = false;
};

}  // namespace taylorcal::commands
