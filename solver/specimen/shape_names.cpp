#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "common/specimen_names.hpp"
#include "solver/specimen/shape.hpp"

#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace taylorcal::specimen {
namespace {

// What names leave out: the paper's specimen and its heads [mm].
constexpr double usual_diameter = 8, usual_length = 40;
constexpr double usual_cone = 20, usual_head = 10;
// Ends and heads beyond these leave cells too thin or too few to compute with.
constexpr double narrowest_end = 0.15, widest_end = 0.9;
constexpr double shortest_head = 0.05, longest_head = 0.8;

void require_share(const std::string& name, const char* what, double share, double lowest,
                   double highest) {
    require(
        share >= lowest && share <= highest,
        fmt::format("shape \"{}\": {} is {:.3g} of the specimen's (expected {} to {}). "
                    "Check the measures in the name.",
                    name, what, share, lowest, highest));
}

/// Of a name with measures in it, as the paper's heads have; nothing when it has none.
std::optional<Profile> measured_profile(const std::string& name) {
    const std::optional<NamedMeasures> mm = measures_in(name);
    if (!mm) return std::nullopt;
    const double diameter = mm->diameter.value_or(usual_diameter);
    const double length = mm->length.value_or(usual_length);
    require(diameter > 0 && length > 0,
            fmt::format("shape \"{}\": a specimen of {} mm x {} mm (expected measures "
                        "above 0).",
                        name, diameter, length));
    const double end = mm->end_diameter / diameter;
    const double head =
        mm->head_length.value_or(mm->is_cone ? usual_cone : usual_head) / length;
    require_share(name, "the end's diameter", end, narrowest_end, widest_end);
    require_share(name, "the head's length", head, shortest_head, longest_head);
    return Profile{mm->is_cone ? ProfileKind::tapered : ProfileKind::stepped, end, head};
}

}  // namespace

std::string full_name(const std::string& name) {
    if (name == "cylinder") return "uniform_cylinder";
    return name == "cone" ? "truncated_cone" : name;
}

Profile profile_named(const std::string& name) {
    const std::string full = full_name(name);
    if (full == "uniform_cylinder") return uniform_cylinder;
    if (full == "truncated_cone") return truncated_cone;
    if (const std::optional<Profile> measured = measured_profile(name)) return *measured;
    std::vector<std::string> understood = {"cylinder", "cone"};
    understood.insert(understood.end(), paper_shapes().begin(), paper_shapes().end());
    throw InputError(fmt::format(
        "shape \"{}\" is unknown{}. Use one of: {}, or measures of your own, as in "
        "reduced_head_5mm_by_12mm or truncated_cone_3mm_of_7.6mm_by_25.4mm.",
        name, nearest_hint(name, understood), fmt::join(paper_shapes(), ", ")));
}

}  // namespace taylorcal::specimen
