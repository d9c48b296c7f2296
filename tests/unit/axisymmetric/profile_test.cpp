#include "solver/axisymmetric/profile.hpp"

#include "solver/observe/outline.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::axisymmetric;
using specimen::Profile;

namespace {

impact::ImpactCase case_of(const Profile& profile) {
    impact::ImpactCase impact_case;
    impact_case.shape = specimen::make_shape(profile);
    impact_case.numerics.elements_across_radius = 6;
    return impact_case;
}

}  // namespace

TEST_CASE("an undeformed specimen has the sizes that it was made with") {
    struct Expected {
        Profile profile;
        double impact_diameter_mm, transition_diameter_mm, undeformed_length_mm;
    };
    // The cone widens by 6 mm over its 20 mm; its foot is read up to 2 mm. Below the rear
    // it keeps its diameter within 0.5 % for 0.005 x 4/0.15 mm more.
    const Expected expected[] = {{specimen::uniform_cylinder, 8, 8, 40},
                                 {specimen::reduced_head_4mm, 4, 4, 30},
                                 {specimen::reduced_head_3mm, 3, 3, 30},
                                 {specimen::truncated_cone, 2 + 0.6, 8, 20.0 + 0.4 / 3}};
    for (const auto& [profile, foot, transition, undeformed] : expected) {
        const impact::ImpactCase impact_case = case_of(profile);
        const Body body(impact_case);
        const observe::Sizes sizes =
            observe::measure(deformed_profile(body, impact_case.shape));
        CHECK(sizes.final_length_mm == Approx(40));
        CHECK(sizes.impact_diameter_mm == Approx(foot));
        CHECK(sizes.transition_diameter_mm == Approx(transition));
        CHECK(sizes.undeformed_length_mm == Approx(undeformed));
        const auto outline = deformed_profile(body, impact_case.shape).outline_height;
        CHECK(outline.front() == 0);
        CHECK(outline.back() == Approx(40e-3));
    }
}

TEST_CASE("an undeformed shoulder is a step in the outline") {
    const impact::ImpactCase impact_case = case_of(specimen::reduced_head_4mm);
    const Body body(impact_case);
    const auto profile = deformed_profile(body, impact_case.shape);
    const auto radius_mm = [&](double height_mm) {
        return 1e3 * observe::silhouette_radius(profile, 1e-3 * height_mm,
                                                profile.outline_height.size());
    };
    CHECK(radius_mm(9.999) == Approx(2));
    CHECK(radius_mm(10.001) == Approx(4));
}

TEST_CASE("a rim thrown out by itself counts half") {
    const impact::ImpactCase impact_case = case_of(specimen::uniform_cylinder);
    Body body(impact_case);
    body.radius[body.mesh.foot.back()] += 0.1e-3;
    const observe::Sizes sizes =
        observe::measure(deformed_profile(body, impact_case.shape));
    CHECK(sizes.impact_diameter_mm == Approx(8 + 0.1));
}
