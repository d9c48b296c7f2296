#pragma once

#include "calibrate/diagnosis/candidate.hpp"
#include "calibrate/measurements/shot.hpp"
#include "calibrate/settings/settings.hpp"
#include "common/hdf5_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A run of the solver without any candidate.
struct BaseRun {
    std::int64_t run_id = 0;
    Shot shot;                   ///< shape, velocity, geometry and temperature only
    Eigen::VectorXd parameters;  ///< plain, in the order of the configuration
    Eigen::VectorXd sizes_mm;    ///< the fitted sizes, NaN where without meaning
    Eigen::VectorXd descriptors;
};

/// The same run with one candidate at some amplitude.
struct EffectRun {
    std::size_t base = 0;  ///< position among the base runs
    std::size_t candidate = 0;
    double amplitude = 0;
    Eigen::VectorXd change_mm;  ///< of the sizes, with the effect minus without
};

/// signatures.h5: runs of the solver in pairs. The two runs of a pair share grains and
/// everything else, so that what changes between them is the effect's alone.
struct PairedRuns {
    std::vector<BaseRun> bases;
    std::vector<EffectRun> effects;
    std::vector<std::string> descriptor_names;
    std::vector<bool> has_column;  ///< of each candidate
    std::size_t failed = 0;        ///< rows that did not finish, left out

    /// Base runs of a shape.
    std::vector<std::size_t> bases_of(const std::string& shape) const;
};

/// InputError naming file, row, column and remedy: a calibrated parameter without a
/// column, two candidates changed in one row, an effect's row without its base.
PairedRuns read_paired_runs(const std::filesystem::path& path, const Settings& settings,
                            const std::vector<Candidate>& candidates);

/// Finer minus base [mm] of the base runs found in both by run id; the rest stays empty.
/// InputError if no run id agrees or a run's inputs differ.
std::vector<Eigen::VectorXd> finer_changes(const PairedRuns& coarse,
                                           const PairedRuns& finer,
                                           const std::filesystem::path& path);

}  // namespace taylorcal::calibrate
