#include "calibrate/comparison/words.hpp"

#include "calibrate/comparison/groups.hpp"
#include "calibrate/measurements/vocabulary.hpp"

#include <algorithm>
#include <cmath>
#include <regex>

#include <fmt/core.h>

namespace taylorcal::calibrate {
namespace {

constexpr double clear = 2.5;  // standard errors, 1 % two-sided

std::string with_spaces(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

bool is_beyond_errors(const ResidualGroup& group) {
    return group.whitened_rms > 1 + clear * group.whitened_rms_sd;
}

bool has_direction(const ResidualGroup& group) {
    return !group.size.empty() &&
           std::abs(group.mean_standardised) > clear * group.mean_standardised_sd;
}

std::string direction(const ResidualGroup& group) {
    const bool too_small = group.mean_relative > 0;
    if (is_outline_score(group.size)) return too_small ? "too low" : "too high";
    if (group.size.find("diameter") != std::string::npos)
        return too_small ? "too narrow" : "too wide";
    return too_small ? "too short" : "too long";
}

std::string subject(const ResidualGroup& group) {
    const std::string size = group.size.empty() ? "" : size_in_words(group.size);
    if (group.by == "use")
        return group.key == use_word(Use::calibrate) ? "fitted shots" : "held-back shots";
    std::string owner =
        group.by == "shape" ? shape_in_words(group.key) : shape_in_words(group.shape);
    if (group.by == "lot") owner = "lot " + with_spaces(group.key);
    if (!owner.empty()) return size.empty() ? owner : owner + ", " + size;
    return size.empty() ? "all sizes" : size;
}

}  // namespace

std::string size_in_words(const std::string& size) {
    if (is_outline_score(size)) return fmt::format("outline, component {}", size.back());
    if (size == "diameter_at_0p2L0_mm") return "diameter at 0.2 L0";
    return with_spaces(size.substr(0, size.rfind("_mm")));
}

std::string reference_in_words(const std::string& size) {
    if (is_outline_score(size)) return " of D0";
    return size == "undeformed_length_mm" ? " of L0" : "";
}

std::string shape_in_words(const std::string& shape) {
    static const std::regex measured("(reduced_head|truncated_cone)_([0-9.]+)mm(.*)");
    std::smatch parts;
    if (!std::regex_match(shape, parts, measured)) return with_spaces(shape);
    const std::string rest = std::regex_replace(parts[3].str(), std::regex("mm"), " mm");
    return fmt::format("{}-mm {}{}", parts[2].str(),
                       parts[1] == "reduced_head" ? "head" : "cone", with_spaces(rest));
}

std::string group_words(const ResidualGroup& group) {
    const std::string where = group.velocity_third.empty()
                                  ? ""
                                  : fmt::format(" at {} velocity", group.velocity_third);
    const std::string weight =
        fmt::format("({} value{}, rms {:.1f} standard errors)", group.n,
                    group.n == 1 ? "" : "s", group.whitened_rms);
    if (has_direction(group))
        return fmt::format("{} predicted {:.1f} %{} {}{} {}", subject(group),
                           100 * std::abs(group.mean_relative),
                           reference_in_words(group.size), direction(group), where,
                           weight);
    if (is_beyond_errors(group))
        return fmt::format("{} off by {:.1f} %{} rms{}, beyond the errors {}",
                           subject(group), 100 * group.rms_relative,
                           reference_in_words(group.size), where, weight);
    return fmt::format("{} within the errors{} {}", subject(group), where, weight);
}

}  // namespace taylorcal::calibrate
