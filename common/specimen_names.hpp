#pragma once

#include <optional>
#include <string>
#include <vector>

namespace taylorcal {

/// The source paper's four specimens, in the order of its code 0-3.
const std::vector<std::string>& paper_shapes();

/// Measures in the name of a head or cone of one's own [mm].
struct NamedMeasures {
    bool is_cone;
    double end_diameter;
    std::optional<double> head_length;
    std::optional<double> diameter, length;  ///< of the specimen
};

/// Those of "reduced_head_5mm_by_12mm" or "truncated_cone_3mm_of_7.6mm_by_25.4mm";
/// nothing when the name has none. workflow/scripts/shape_names.py reads the same names.
std::optional<NamedMeasures> measures_in(const std::string& shape);

}  // namespace taylorcal
