#include "solver/effects/effect.hpp"

namespace taylorcal::effects {
namespace {

constexpr double share_of_111 = 0.6;  // of the textured grains; the rest has <100>

/// Turns the grain by the least angle that lays one of its axes of a family (signs of
/// `axis` free) along z.
Eigen::Quaterniond laid_along_z(const Eigen::Quaterniond& grain,
                                const Eigen::Vector3d& axis) {
    Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
    for (int signs = 0; signs < 8; ++signs) {
        for (int shift = 0; shift < 3; ++shift) {
            Eigen::Vector3d candidate;
            for (int i = 0; i < 3; ++i)
                candidate(i) = (signs & (1 << i) ? -1 : 1) * axis((i + shift) % 3);
            const Eigen::Vector3d in_lab = grain * candidate;
            if (in_lab.z() > nearest.z()) nearest = in_lab;
        }
    }
    return Eigen::Quaterniond::FromTwoVectors(nearest, Eigen::Vector3d::UnitZ()) * grain;
}

}  // namespace

Effect rod_texture() {
    return {
        .name = "rod_texture",
        .symbol = "fT",
        .equation =
            "a share fT of grains has <111> (60 %) or <100> (40 %) along the axis",
        .unit = "1",
        .lowest = 0,
        .highest = 1,
        .prior = {PriorKind::half_normal, 0.4},
        .typical = 0.5,
        .is_signed = false,
        .acts_on = ActsOn::initial_state,
        .geometries = both_geometries,
        .needs_dislocations = true,
        .description = "double fibre texture of drawn and extruded rods",
        .source =
            "drawn copper, 60 % <111> and 40 % <100>: Schmid and Wassermann 1927, quoted "
            "by Kuczynski 1950 (Nature 165, 562). What share of a rod's grains is so "
            "turned is a judgement, no source",
        .apply =
            [](impact::ImpactCase& impact_case, double share) {
                impact_case.additions.orientations.push_back(
                    [=](const Eigen::Quaterniond& drawn, double uniform) {
                        if (uniform >= share) return drawn;
                        return uniform < share_of_111 * share
                                   ? laid_along_z(drawn,
                                                  Eigen::Vector3d::Ones().normalized())
                                   : laid_along_z(drawn, Eigen::Vector3d::UnitX());
                    });
            },
    };
}

}  // namespace taylorcal::effects
