#include "calibrate/posterior/posterior_file.hpp"

#include "calibrate/posterior/maps_file.hpp"
#include "common/errors.hpp"
#include "common/hdf5_file.hpp"
#include "common/provenance.hpp"

#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace taylorcal::calibrate {
namespace {

void write_maxima(Hdf5Writer& file, const std::vector<Maximum>& maxima,
                  const ParameterSpace& space, const SpreadLevels& levels) {
    RowMatrix units(static_cast<Eigen::Index>(maxima.size()),
                    static_cast<Eigen::Index>(space.size()));
    std::vector<std::size_t> level;
    std::vector<double> densities, shares;
    for (const Maximum& maximum : maxima) {
        units.row(static_cast<Eigen::Index>(level.size())) = maximum.unit.transpose();
        level.push_back(maximum.level);
        densities.push_back(maximum.log_density);
        shares.push_back(maximum.share);
    }
    file.matrix("maxima", plain_columns(units, level, space, levels));
    file.attribute("names", column_names(space, levels), "maxima");
    file.numbers("maxima_log_density", densities);
    file.numbers("maxima_share", shares);
}

/// The level whose value is nearest to each number of the last column.
std::vector<std::size_t> nearest_levels(const RowMatrix& plain,
                                        const SpreadLevels& levels) {
    std::vector<std::size_t> found(static_cast<std::size_t>(plain.rows()), 0);
    if (!levels.is_free()) return found;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double value = plain(static_cast<Eigen::Index>(i), plain.cols() - 1);
        for (std::size_t g = 1; g < levels.values.size(); ++g)
            if (std::abs(levels.values[g] - value) <
                std::abs(levels.values[found[i]] - value))
                found[i] = g;
    }
    return found;
}

/// A table of points, each with a finite number in every column.
RowMatrix points_from(const Hdf5Reader& file, const std::filesystem::path& path,
                      const std::string& name, std::size_t columns) {
    RowMatrix points = file.matrix(name);
    require(points.rows() > 0 && points.cols() == static_cast<Eigen::Index>(columns) &&
                points.allFinite(),
            fmt::format("{}: \"{}\" is {} x {}{} (expected at least one row of {} finite "
                        "numbers). Sample again.",
                        path.string(), name, points.rows(), points.cols(),
                        points.allFinite() ? "" : ", with numbers that are not finite",
                        columns));
    return points;
}

RowMatrix to_units(const RowMatrix& plain, const ParameterSpace& space) {
    RowMatrix units(plain.rows(), static_cast<Eigen::Index>(space.size()));
    for (Eigen::Index i = 0; i < units.rows(); ++i)
        for (Eigen::Index j = 0; j < units.cols(); ++j)
            units(i, j) = space.unit(static_cast<std::size_t>(j), plain(i, j));
    return units;
}

}  // namespace

std::vector<std::string> column_names(const ParameterSpace& space,
                                      const SpreadLevels& levels) {
    std::vector<std::string> names = space.names();
    if (levels.is_free()) names.push_back(levels.name);
    return names;
}

RowMatrix plain_columns(const RowMatrix& units, const std::vector<std::size_t>& level,
                        const ParameterSpace& space, const SpreadLevels& levels) {
    RowMatrix plain(units.rows(), units.cols() + (levels.is_free() ? 1 : 0));
    for (Eigen::Index i = 0; i < units.rows(); ++i) {
        plain.row(i).head(units.cols()) =
            space.values(units.row(i).transpose()).transpose();
        if (levels.is_free())
            plain(i, units.cols()) = levels.values[level[static_cast<std::size_t>(i)]];
    }
    return plain;
}

void write_posterior(const std::filesystem::path& path, const PosteriorResult& result,
                     const ParameterSpace& space, const SpreadLevels& levels,
                     const Settings& settings) {
    const Posterior& posterior = result.posterior;
    const bool paper = settings.likelihood == LikelihoodForm::paper;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Hdf5Writer file(path);
    file.attribute("schema", posterior_schema);
    file.attribute("ln_evidence", paper ? none : posterior.log_evidence);
    file.attribute("ln_evidence_sd", paper ? none : posterior.log_evidence_sd);
    file.attribute("effective_sample_size", posterior.effective_sample_size);
    file.attribute("draws_total", static_cast<double>(posterior.draws));
    file.attribute("draws_per_lot", static_cast<double>(posterior.draws_per_lot));
    file.attribute("predictions_total", static_cast<double>(posterior.predictions));
    file.attribute("adaptation_passes", static_cast<double>(posterior.adaptations));
    file.attribute("drawn_from_prior", posterior.drawn_from_prior ? 1.0 : 0.0);
    file.attribute("configuration", settings.source.dump());
    file.attribute("provenance",
                   provenance("calibrate", settings.seed, settings.source).dump());
    file.matrix("draws", plain_columns(posterior.kept.units, posterior.kept.levels, space,
                                       levels));
    file.attribute("names", column_names(space, levels), "draws");
    const Eigen::VectorXd reference = space.values(posterior.reference);
    file.numbers("reference", {reference.data(), reference.data() + reference.size()});
    file.attribute("names", space.names(), "reference");
    write_maxima(file, result.maxima, space, levels);
    write_maps(file, result.maps);
    if (result.plain) write_findings(file, *result.plain, space, settings);
    file.close();
}

StoredPosterior read_posterior(const std::filesystem::path& path,
                               const ParameterSpace& space, const SpreadLevels& levels,
                               const Settings& settings) {
    const Hdf5Reader file(path);
    file.expect_schema(posterior_schema);
    const std::vector<std::string> expected = column_names(space, levels);
    const std::vector<std::string> found = file.texts_attribute("names", "draws");
    require(
        found == expected,
        fmt::format("{}: its parameters are {}, while the configuration and the table "
                    "ask for {}. Sample again.",
                    path.string(), fmt::join(found, ", "), fmt::join(expected, ", ")));
    require(
        nlohmann::json::parse(file.text_attribute("configuration")) == settings.source,
        fmt::format("{}: it was sampled with another configuration than the one given. "
                    "Sample again.",
                    path.string()));
    StoredPosterior stored;
    stored.draws = points_from(file, path, "draws", expected.size());
    stored.maxima = points_from(file, path, "maxima", expected.size());
    stored.units = to_units(stored.draws, space);
    stored.maxima_units = to_units(stored.maxima, space);
    stored.levels = nearest_levels(stored.draws, levels);
    stored.maxima_levels = nearest_levels(stored.maxima, levels);
    std::vector<double> reference = file.numbers("reference");
    require(reference.size() == space.size(),
            fmt::format("{}: \"reference\" has {} numbers (expected {}). Sample again.",
                        path.string(), reference.size(), space.size()));
    stored.reference =
        to_units(Eigen::Map<RowMatrix>(reference.data(), 1,
                                       static_cast<Eigen::Index>(reference.size())),
                 space)
            .row(0)
            .transpose();
    return stored;
}

}  // namespace taylorcal::calibrate
