#pragma once

#include "calibrate/posterior/maps.hpp"
#include "calibrate/posterior/maxima.hpp"
#include "calibrate/posterior/plain_findings.hpp"
#include "calibrate/sampling/sample_posterior.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

inline constexpr const char* posterior_schema = "taylorcal/posterior/1";

/// Everything that sampling found, ready to be written.
struct PosteriorResult {
    Posterior posterior;
    Maps maps;
    std::vector<Maximum> maxima;
    /// Of plain draws only.
    std::optional<PlainFindings> plain;
};

/// Names of the columns of `draws` and `maxima`: the coordinates, then the spread if
/// free.
std::vector<std::string> column_names(const ParameterSpace& space,
                                      const SpreadLevels& levels);

/// Plain values of points and levels, columns as `column_names`.
RowMatrix plain_columns(const RowMatrix& units, const std::vector<std::size_t>& level,
                        const ParameterSpace& space, const SpreadLevels& levels);

/// Writes posterior.h5. The paper's likelihood has no evidence (NaN): its one sigma is
/// not a model of the errors.
void write_posterior(const std::filesystem::path& path, const PosteriorResult& result,
                     const ParameterSpace& space, const SpreadLevels& levels,
                     const Settings& settings);

/// What comparing needs of posterior.h5, back in the unit cube.
struct StoredPosterior {
    RowMatrix draws;   ///< equally weighted, plain values with the spread last
    RowMatrix maxima;  ///< the best first
    RowMatrix units;   ///< the draws' points of the unit cube
    std::vector<std::size_t> levels;
    RowMatrix maxima_units;
    std::vector<std::size_t> maxima_levels;
    Eigen::VectorXd reference;  ///< where df/dv was taken, unit cube
};

/// InputError if the file is not of this configuration.
StoredPosterior read_posterior(const std::filesystem::path& path,
                               const ParameterSpace& space, const SpreadLevels& levels,
                               const Settings& settings);

}  // namespace taylorcal::calibrate
