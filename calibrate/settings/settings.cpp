#include "calibrate/settings/settings.hpp"

#include "calibrate/measurements/vocabulary.hpp"
#include "common/json_reader.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

/// Reads the scale of a normal prior and checks that the range suits it.
double read_normal_scale(const JsonReader& reader, const std::string& prior, double lower,
                         double upper) {
    const double scale = reader.number("scale");
    if (!(scale > 0))
        reader.fail("scale",
                    fmt::format("= {} is not the standard deviation of a {} prior "
                                "(expected a positive number).",
                                scale, prior));
    if (prior == "half_normal" && lower < 0)
        reader.fail("lower", fmt::format("= {} is below 0, where a half_normal prior "
                                         "ends. Raise it or use normal.",
                                         lower));
    // Beyond, the prior's mass within the range is lost in rounding.
    constexpr double farthest = 6;
    const double nearest = std::clamp(0.0, lower, upper);
    if (std::abs(nearest) > farthest * scale)
        reader.fail("scale",
                    fmt::format("= {} leaves no {} prior around 0 in the range {} to {}. "
                                "Raise it or move the range.",
                                scale, prior, lower, upper));
    return scale;
}

Parameter read_parameter(const JsonReader& reader) {
    Parameter parameter;
    parameter.name = reader.text("name");
    parameter.lower = reader.number("lower");
    parameter.upper = reader.number("upper");
    const std::string prior = reader.word(
        "prior", {"uniform", "log_uniform", "half_normal", "normal"}, "uniform");
    const bool is_normal = prior == "half_normal" || prior == "normal";
    if (is_normal)
        reader.only({"name", "lower", "upper", "prior", "scale", "scope"});
    else
        reader.only({"name", "lower", "upper", "prior", "scope"});
    parameter.log_uniform = prior == "log_uniform";
    parameter.per_lot =
        reader.word("scope", {"shared", "per_lot"}, "shared") == "per_lot";
    if (!(parameter.upper > parameter.lower))
        reader.fail("upper", fmt::format("= {} is not above lower = {}. Widen the range.",
                                         parameter.upper, parameter.lower));
    if (parameter.log_uniform && !(parameter.lower > 0))
        reader.fail("lower",
                    fmt::format("= {} cannot bound a log_uniform prior (expected "
                                "a positive number). Raise it or use uniform.",
                                parameter.lower));
    if (is_normal)
        parameter.normal_scale =
            read_normal_scale(reader, prior, parameter.lower, parameter.upper);
    return parameter;
}

std::vector<Parameter> read_parameters(const JsonReader& reader) {
    std::vector<Parameter> parameters;
    std::set<std::string> names;
    for (const JsonReader& entry : reader.objects("parameters")) {
        parameters.push_back(read_parameter(entry));
        if (!names.insert(parameters.back().name).second)
            entry.fail("name", fmt::format("= \"{}\" occurs twice. Remove one of them.",
                                           parameters.back().name));
    }
    if (parameters.empty())
        reader.fail("parameters", "is empty (nothing to calibrate). Name a parameter.");
    return parameters;
}

std::vector<std::string> read_fit_sizes(const JsonReader& reader) {
    const std::vector<std::string> sizes = reader.texts("fit_sizes");
    if (sizes.empty())
        reader.fail("fit_sizes", "is empty (nothing to fit). Name a measured size.");
    const auto& known = size_columns();
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (std::find(known.begin(), known.end(), sizes[i]) == known.end()) {
            reader.fail(
                "fit_sizes",
                fmt::format("holds the unknown size \"{}\".{}", sizes[i],
                            nearest_hint(sizes[i], known, " Did you mean \"", "\"?")));
        }
        if (std::find(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(i),
                      sizes[i]) != sizes.begin() + static_cast<std::ptrdiff_t>(i))
            reader.fail("fit_sizes", fmt::format("holds \"{}\" twice.", sizes[i]));
    }
    return sizes;
}

std::optional<UnexplainedSpread> read_spread(const JsonReader& reader) {
    const char* key = "unexplained_spread";
    if (!reader.json().contains(key) || reader.json()[key].is_null()) return std::nullopt;
    const JsonReader entry = reader.object(key);
    entry.only({"prior_scale", "grid"});
    UnexplainedSpread spread;
    spread.prior_scale = entry.number_in("prior_scale", 1e-6, 10, spread.prior_scale);
    spread.grid = entry.numbers("grid");
    const bool rising = std::adjacent_find(spread.grid.begin(), spread.grid.end(),
                                           [](double a, double b) { return a >= b; }) ==
                        spread.grid.end();
    if (spread.grid.empty() || !rising || spread.grid.front() != 0)
        entry.fail("grid",
                   "must hold rising relative spreads from 0, for instance "
                   "[0, 0.005, 0.01, 0.02, 0.04].");
    return spread;
}

std::uint64_t read_count(const JsonReader& reader, const char* key, std::uint64_t lowest,
                         std::uint64_t default_value) {
    const long long value = reader.integer(key, static_cast<long long>(default_value));
    if (value < static_cast<long long>(lowest))
        reader.fail(
            key, fmt::format("= {} is too small (expected at least {}).", value, lowest));
    return static_cast<std::uint64_t>(value);
}

/// How draws are made, and whether plain ones can be.
void read_draws_from(const JsonReader& reader, Settings& settings) {
    settings.draws_from =
        reader.word("draws_from", {"adapted", "prior"}, "adapted") == "prior"
            ? DrawsFrom::prior
            : DrawsFrom::adapted;
    settings.draw_sequence =
        reader.word("draw_sequence", {"random", "sobol"}, "random") == "sobol"
            ? DrawSequence::sobol
            : DrawSequence::random;
    if (settings.draws_from == DrawsFrom::adapted) {
        if (settings.draw_sequence == DrawSequence::sobol)
            reader.fail("draw_sequence",
                        "= sobol is for plain draws (expected draws_from = prior).");
        return;
    }
    const auto own = std::count_if(settings.parameters.begin(), settings.parameters.end(),
                                   [](const Parameter& p) { return p.per_lot; });
    constexpr std::size_t most_shared = 4;
    if (own > 0 || settings.parameters.size() > most_shared)
        reader.fail("draws_from",
                    fmt::format("= prior is for at most {} shared parameters (found {}, "
                                "of which {} belong to the lots). Use adapted.",
                                most_shared, settings.parameters.size(), own));
}

/// Common unless the likelihood goes row by row.
void read_network_errors(const JsonReader& reader, Settings& settings) {
    const bool by_row = settings.draws_from == DrawsFrom::prior ||
                        settings.likelihood == LikelihoodForm::paper;
    const char* key = "network_errors";
    const bool common = reader.word(key, {"common", "independent"},
                                    by_row ? "independent" : "common") == "common";
    if (common && by_row)
        reader.fail(key,
                    "= common cannot go with plain draws or the paper's likelihood "
                    "(expected independent).");
    settings.network_errors = common ? NetworkErrors::common : NetworkErrors::independent;
}

Settings read(const JsonReader& reader) {
    reader.only({"parameters", "fit_sizes", "likelihood", "velocity_sd_relative",
                 "unexplained_spread", "network_errors", "draws_from", "draw_sequence",
                 "draws", "draws_per_lot", "seed", "kept_draws"});
    Settings settings;
    settings.parameters = read_parameters(reader);
    settings.fit_sizes = read_fit_sizes(reader);
    settings.likelihood = reader.word("likelihood", {"full", "paper"}, "full") == "full"
                              ? LikelihoodForm::full
                              : LikelihoodForm::paper;
    settings.velocity_sd_relative =
        reader.number_in("velocity_sd_relative", 0, 0.5, settings.velocity_sd_relative);
    settings.unexplained_spread = read_spread(reader);
    read_draws_from(reader, settings);
    read_network_errors(reader, settings);
    settings.draws = read_count(reader, "draws", 100, settings.draws);
    settings.draws_per_lot =
        read_count(reader, "draws_per_lot", 1, settings.draws_per_lot);
    settings.seed = read_count(reader, "seed", 0, settings.seed);
    settings.kept_draws = read_count(reader, "kept_draws", 10, settings.kept_draws);
    settings.source = reader.json();
    return settings;
}

}  // namespace

Settings read_settings(const std::filesystem::path& path) {
    return read(JsonReader::from_file(path));
}

Settings parse_settings(const nlohmann::json& json, const std::string& where) {
    return read(JsonReader(json, where));
}

}  // namespace taylorcal::calibrate
