#include "common/errors.hpp"
#include "common/nearest_word.hpp"
#include "solver/impact/impact_case.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace taylorcal::impact {
namespace {

/// Where `word` stands among `known`; InputError with the nearest one otherwise.
std::size_t position(const std::string& what, const std::string& word,
                     const std::vector<std::string>& known) {
    const auto found = std::find(known.begin(), known.end(), word);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    throw InputError(fmt::format("{} \"{}\" is unknown{}. Use one of: {}.", what, word,
                                 nearest_hint(word, known), fmt::join(known, ", ")));
}

struct Resolution {
    int elements_across_radius;
    int grains_per_point;
    std::int64_t
        point_update_limit;  ///< a specimen that flattens into a disc costs no more
};

// By fidelity. 4k, 14k and 46k particles in a 3D cylinder (the paper has 45k to 63k). One
// grain a particle is the paper's method, but bends and softens heads; with four, sizes
// scatter less and are those of more grains. In (r, z) a cell stands for a whole ring, so
// that its grains must be averaged.
constexpr Resolution axisymmetric_resolution[] = {
    {5, 8, 20'000'000}, {8, 16, 100'000'000}, {12, 16, 500'000'000}};
constexpr Resolution three_dimensional_resolution[] = {
    {4, 1, 2'000'000'000}, {6, 4, 8'000'000'000}, {9, 4, 40'000'000'000}};

}  // namespace

const std::vector<std::string>& geometry_names() {
    static const std::vector<std::string> names = {"axisymmetric", "3d"};
    return names;
}

const std::vector<std::string>& fidelity_names() {
    static const std::vector<std::string> names = {"coarse", "standard", "fine"};
    return names;
}

Geometry geometry_from_name(const std::string& name) {
    return static_cast<Geometry>(position("geometry", name, geometry_names()));
}

Numerics numerics_for(Geometry geometry, const std::string& fidelity) {
    const std::size_t level = position("fidelity", fidelity, fidelity_names());
    const Resolution resolution = geometry == Geometry::axisymmetric
                                      ? axisymmetric_resolution[level]
                                      : three_dimensional_resolution[level];
    Numerics numerics;
    numerics.geometry = geometry;
    numerics.elements_across_radius = resolution.elements_across_radius;
    numerics.grains_per_point = resolution.grains_per_point;
    numerics.point_update_limit = resolution.point_update_limit;
    if (geometry == Geometry::axisymmetric) {
        // Cells are stable to about 1; particles have a smaller stable step, hourglass
        // control of another form, and no need of linear viscosity (the defaults).
        numerics.cfl = 0.7;
        numerics.refined_mesh = level > 0;
        numerics.hourglass = 0.1;
        numerics.linear_viscosity = 0.04;
    }
    return numerics;
}

}  // namespace taylorcal::impact
