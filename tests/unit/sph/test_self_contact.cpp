#include "solver/sph/reference.hpp"
#include "solver/sph/self_contact.hpp"
#include "solver/sph/surface.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

/// A bar whose upper half is moved sideways and laid so deep into its lower half that the
/// two stand side by side, `gap` edges between their outermost planes of particles.
struct FoldedBar {
    explicit FoldedBar(double gap) {
        particles.position = {packing.x, packing.y, packing.z};
        double widest = 0;
        for (const double x : packing.x) widest = std::max(widest, x);
        for (std::size_t slot = 0; slot < packing.slots; ++slot) {
            if (packing.volume[slot] <= 0 || !upper(slot)) continue;
            particles.position[0][slot] += 2 * widest + gap * packing.edge;
            particles.position[2][slot] -= 20e-3;
            particles.velocity[0][slot] = -50;
        }
    }
    void separate() {
        schedule.plan(std::vector<double>(packing.active.size(), 1e-8));
        schedule.start(contact.approaching(particles, schedule.duration()));
        contact.separate(particles, schedule, 0);
    }
    bool upper(std::size_t slot) const { return packing.z[slot] > 20e-3; }
    double momentum() const {
        double sum = 0;
        for (std::size_t slot = 0; slot < packing.slots; ++slot) {
            sum += packing.volume[slot] * particles.velocity[0][slot];
        }
        return sum;
    }

    specimen::Shape shape = specimen::make_shape(specimen::uniform_cylinder, 8e-3, 40e-3);
    sph::Packing packing = sph::pack(shape, 1e-3);
    sph::Particles particles{packing.slots};
    sph::SelfContact contact{shape, packing, 8930};
    sph::Schedule schedule{packing, sph::Reference(packing, 8930).stencils(packing)};
};

}  // namespace

TEST_CASE("surfaces that fold onto each other lose their approach, not momentum",
          "[self_contact]") {
    FoldedBar bar(0.3);
    const double before = bar.momentum();
    bar.separate();
    CHECK(bar.momentum() == Approx(before).epsilon(1e-12));
    CHECK(bar.contact.lost_energy() > 0);
    double kinetic_loss = 0;
    std::size_t moved = 0;
    for (std::size_t slot = 0; slot < bar.packing.slots; ++slot) {
        if (bar.packing.volume[slot] <= 0) continue;
        const double initial = bar.upper(slot) ? 50 : 0;
        double square = 0;
        for (const auto& component : bar.particles.velocity) {
            square += component[slot] * component[slot];
        }
        kinetic_loss +=
            0.5 * 8930 * bar.packing.volume[slot] * (initial * initial - square);
        if (!bar.upper(slot) && bar.particles.velocity[0][slot] < 0) ++moved;
    }
    CHECK(moved > 10);
    CHECK(kinetic_loss == Approx(bar.contact.lost_energy()).epsilon(1e-9));
}

TEST_CASE("surfaces apart and reference neighbours are left alone", "[self_contact]") {
    FoldedBar bar(1.5);
    bar.separate();
    CHECK(bar.contact.lost_energy() == 0);
}

TEST_CASE("surfaces meet where deformed particles have them", "[self_contact]") {
    FoldedBar thinned(0.3), thick(0.3);
    for (double& across : thinned.particles.deformation[0]) across = 0.2;
    thinned.separate();
    thick.separate();
    CHECK(thinned.contact.lost_energy() == 0);
    CHECK(thick.contact.lost_energy() > 0);
}

TEST_CASE("what bulges meets what is opposite alone", "[self_contact]") {
    FoldedBar bar(0.8);
    const auto& x = bar.particles.position;
    // The outermost particle of the lower half, at mid-height, reaches into the upper
    // one.
    std::size_t bulge = 0;
    for (std::size_t slot = 0; slot < bar.packing.slots; ++slot) {
        if (bar.packing.volume[slot] <= 0 || bar.upper(slot) || x[2][slot] < 10e-3)
            continue;
        if (bar.packing.volume[bulge] <= 0 || x[0][slot] > x[0][bulge] + 1e-9)
            bulge = slot;
    }
    bar.particles.position[0][bulge] += bar.packing.edge;
    bar.particles.deformation[8][bulge] = 3;  // its plane lies along many others
    bar.separate();
    const auto apart = [&](std::size_t i, std::size_t j) {
        return std::hypot(x[1][i] - x[1][j], x[2][i] - x[2][j]);
    };
    std::size_t moved = 0;
    for (std::size_t slot = 0; slot < bar.packing.slots; ++slot) {
        if (bar.packing.volume[slot] <= 0 || !bar.upper(slot)) continue;
        if (bar.particles.velocity[0][slot] == -50) continue;
        ++moved;
        CHECK(apart(slot, bulge) < 0.7 * bar.packing.edge);
    }
    CHECK(moved > 0);
}

TEST_CASE("surface elements lie on the flank and on the shoulder", "[self_contact]") {
    const auto profile = GENERATE(specimen::uniform_cylinder, specimen::reduced_head_3mm,
                                  specimen::truncated_cone);
    const specimen::Shape shape = specimen::make_shape(profile);
    const sph::Packing packing = sph::pack(shape, 0.8e-3);
    std::set<double> flank_heights;
    double shoulder_area = 0;
    for (const sph::SurfaceElement& element : sph::surface_elements(shape, packing)) {
        const Eigen::Vector3d place(packing.x[element.slot], packing.y[element.slot],
                                    packing.z[element.slot]);
        const Eigen::Vector3d point = place + element.depth * element.normal;
        CHECK(element.normal.norm() == Approx(1));
        if (element.normal.z() == -1) {
            CHECK(point.z() == Approx(shape.head_length));
            shoulder_area += packing.volume[element.slot] / (2 * element.depth);
        } else {
            CHECK(point.head<2>().norm() ==
                  Approx(shape.radius_at(place.z()) +
                         (point.z() - place.z()) * -element.normal.z() /
                             element.normal.head<2>().norm()));
            flank_heights.insert(place.z());
        }
    }
    CHECK(flank_heights.size() == packing.layers.size());
    const double step = profile.kind == specimen::ProfileKind::stepped
                            ? std::numbers::pi * (std::pow(shape.rear_radius(), 2) -
                                                  std::pow(shape.station_radius[0], 2))
                            : 0;
    CHECK(shoulder_area == Approx(step).epsilon(0.15));
}
