#include "calibrate/measurements/read_table.hpp"

#include "calibrate/measurements/vocabulary.hpp"
#include "common/csv_table.hpp"
#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/specimen_names.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::calibrate {
namespace {

std::string hint(const std::string& word, const std::vector<std::string>& candidates) {
    return nearest_hint(word, candidates, " Did you mean \"", "\"?");
}

void check_columns(const CsvTable& table, const std::string& file) {
    const auto& known = known_columns();
    for (const std::string& column : table.columns()) {
        const bool is_known =
            std::find(known.begin(), known.end(), column) != known.end();
        require(
            is_known,
            fmt::format("{}, line 1: unknown column \"{}\" (units belong to the name: "
                        "velocity_m_s, lengths _mm, temperature _K).{} Rename it or "
                        "remove it.",
                        file, column, hint(column, known)));
    }
    for (const std::string& column : required_columns())
        require(table.has(column),
                fmt::format(
                    "{}, line 1: column \"{}\" is missing (a table needs {}). Add it.",
                    file, column, fmt::join(required_columns(), ", ")));
    for (const std::string& size : size_columns())
        require(!table.has(size) || table.has(size + "_sd"),
                fmt::format("{}, line 1: column \"{}\" has no companion \"{}_sd\" (every "
                            "measured size needs its standard deviation). Add it.",
                            file, size, size));
}

/// A row of the table under check.
struct Row {
    const CsvTable& table;
    std::size_t row;

    std::string text(const std::string& column) const {
        const std::string& value = table.text(row, column);
        if (value.empty())
            table.fail(row, column, "is empty (expected a text). Fill it in.");
        return value;
    }
    std::size_t word(const std::string& column, const std::vector<std::string>& allowed,
                     const std::string& what) const {
        const std::string& value = table.text(row, column);
        const auto found = std::find(allowed.begin(), allowed.end(), value);
        if (found == allowed.end())
            table.fail(
                row, column,
                fmt::format("is an unknown {} (expected one of: {}).{} Correct it.", what,
                            fmt::join(allowed, ", "), hint(value, allowed)));
        return static_cast<std::size_t>(found - allowed.begin());
    }
    std::optional<double> positive_if_any(const std::string& column) const {
        if (!table.has(column)) return std::nullopt;
        const std::optional<double> value = table.number(row, column);
        if (value && !(*value > 0 && *value < 1e300))
            table.fail(row, column,
                       "is not a positive finite number. Correct it, or leave the cell "
                       "empty where nothing was measured.");
        return value;
    }
    /// For a part that may be gone: nothing of a soft rod keeps its diameter.
    std::optional<double> at_least_zero_if_any(const std::string& column) const {
        if (table.has(column) && table.number(row, column) == 0.0) return 0.0;
        return positive_if_any(column);
    }
    std::optional<double> finite_if_any(const std::string& column) const {
        if (!table.has(column)) return std::nullopt;
        const std::optional<double> value = table.number(row, column);
        if (value && !std::isfinite(*value))
            table.fail(row, column,
                       "is not a finite number. Correct it, or leave the cell empty "
                       "where nothing was measured.");
        return value;
    }
    double positive(const std::string& column) const {
        const std::optional<double> value = positive_if_any(column);
        if (!value)
            table.fail(row, column, "is empty (expected a positive number). Fill it in.");
        return *value;
    }
};

std::optional<double> read_size(const Row& row, const std::string& size) {
    if (is_outline_score(size)) return row.finite_if_any(size);
    return size == "undeformed_length_mm" ? row.at_least_zero_if_any(size)
                                          : row.positive_if_any(size);
}

std::vector<Measurement> read_sizes(const Row& row) {
    std::vector<Measurement> sizes;
    for (const std::string& column : size_columns()) {
        const std::optional<double> value = read_size(row, column);
        if (!value) continue;
        const std::optional<double> sd = row.positive_if_any(column + "_sd");
        if (!sd)
            row.table.fail(row.row, column + "_sd",
                           fmt::format("is empty while {} = {} is measured (expected its "
                                       "standard deviation in mm). State the error.",
                                       column, *value));
        sizes.push_back({column, *value, *sd});
    }
    return sizes;
}

Shot read_shot(const Row& row) {
    Shot shot;
    shot.id = row.text("id");
    shot.place = row.table.place(row.row);
    shot.lot = row.text("lot");
    shot.use = static_cast<Use>(row.word("use", use_words(), "use"));
    shot.shape = row.text("shape");
    if (!measures_in(shot.shape)) row.word("shape", paper_shapes(), "shape");
    shot.velocity_m_s = row.positive("velocity_m_s");
    shot.velocity_sd_m_s = row.positive_if_any("velocity_sd_m_s");
    shot.initial_temperature_K = row.positive("initial_temperature_K");
    shot.initial_diameter_mm = row.positive("initial_diameter_mm");
    shot.initial_length_mm = row.positive("initial_length_mm");
    shot.source = row.text("source");
    row.positive_if_any("density_kg_m3");
    shot.sizes = read_sizes(row);
    return shot;
}

}  // namespace

std::vector<Shot> read_measurements(const std::filesystem::path& path) {
    const CsvTable table = CsvTable::from_file(path);
    check_columns(table, path.string());
    require(
        table.rows() > 0,
        fmt::format("{}: the table is empty (expected one row a shot under the header). "
                    "Add the measured shots.",
                    path.string()));
    std::vector<Shot> shots;
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        shots.push_back(read_shot({table, i}));
        if (!seen.emplace(shots.back().id, i).second)
            table.fail(i, "id",
                       "occurs twice (expected one row a shot). Rename one of them.");
    }
    return shots;
}

}  // namespace taylorcal::calibrate
