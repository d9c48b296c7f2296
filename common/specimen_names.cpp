#include "common/specimen_names.hpp"

#include <regex>

namespace taylorcal {

const std::vector<std::string>& paper_shapes() {
    static const std::vector<std::string> names = {"uniform_cylinder", "reduced_head_4mm",
                                                   "reduced_head_3mm", "truncated_cone"};
    return names;
}

std::optional<NamedMeasures> measures_in(const std::string& shape) {
    static const std::string mm = "_([0-9]+(?:[.][0-9]+)?)mm";
    static const std::regex pattern("(reduced_head|truncated_cone)" + mm + "(?:_by" + mm +
                                    ")?(?:_of" + mm + "_by" + mm + ")?");
    std::smatch parts;
    if (!std::regex_match(shape, parts, pattern)) return std::nullopt;
    const auto measure = [&](std::size_t part) {
        return parts[part].matched ? std::optional(std::stod(parts[part])) : std::nullopt;
    };
    return NamedMeasures{parts[1] == "truncated_cone", std::stod(parts[2]), measure(3),
                         measure(4), measure(5)};
}

}  // namespace taylorcal
