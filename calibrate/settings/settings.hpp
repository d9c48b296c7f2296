#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace taylorcal::calibrate {

/// A calibrated parameter with its prior.
struct Parameter {
    std::string name;
    double lower = 0;
    double upper = 1;
    bool log_uniform = false;  ///< uniform in the logarithm instead of in the value
    bool per_lot = false;      ///< one value a lot of metal instead of one for all
    /// Standard deviation of a normal prior around 0, cut off at the range's ends (half
    /// normal when lower = 0): of an effect, which is absent at 0.
    std::optional<double> normal_scale = std::nullopt;
};

/// Relative spread that no other error explains, with a half-normal prior.
struct UnexplainedSpread {
    double prior_scale = 0.02;
    std::vector<double> grid;  ///< values over which it is marginalised, rising
};

/// `full`: every error with its covariance. `paper`: one sigma for all relative
/// deviations.
enum class LikelihoodForm { full, paper };

/// Whether shots of one lot share the network's error (its correlation is then part of
/// the likelihood), or each has its own.
enum class NetworkErrors { common, independent };

/// Where draws come from: a proposal that is adapted to the posterior, or the prior
/// itself (plain draws in one long pass, of at most four shared parameters).
enum class DrawsFrom { adapted, prior };

/// How plain draws follow each other: as random numbers, or as a scrambled Sobol
/// sequence.
enum class DrawSequence { random, sobol };

/// The configuration of all subcommands of `calibrate` (calibrate.json).
struct Settings {
    std::vector<Parameter> parameters;
    std::vector<std::string> fit_sizes;
    LikelihoodForm likelihood = LikelihoodForm::full;
    double velocity_sd_relative = 0.01;
    std::optional<UnexplainedSpread> unexplained_spread;
    NetworkErrors network_errors = NetworkErrors::common;
    DrawsFrom draws_from = DrawsFrom::adapted;
    DrawSequence draw_sequence = DrawSequence::random;
    std::uint64_t draws = 20000;       ///< of the shared parameters
    std::uint64_t draws_per_lot = 32;  ///< of a lot's own parameters, for each of them
    std::uint64_t seed = 1;
    std::uint64_t kept_draws = 4000;  ///< equally weighted, written to the file
    nlohmann::json source;            ///< as read, for provenance
};

/// Reads calibrate.json strictly. InputError names the file, the key and the remedy.
Settings read_settings(const std::filesystem::path& path);
Settings parse_settings(const nlohmann::json& json, const std::string& where);

}  // namespace taylorcal::calibrate
