#include "solver/sph/reference.hpp"
#include "solver/sph/self_contact.hpp"

#include <cmath>

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

    sph::Packing packing =
        sph::pack(specimen::make_shape(specimen::uniform_cylinder, 8e-3, 40e-3), 1e-3);
    sph::Particles particles{packing.slots};
    sph::SelfContact contact{packing, 8930};
    sph::Schedule schedule{packing, sph::Reference(packing, 8930, 0).stencils(packing)};
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
