#include "solver/material/elastic.hpp"
#include "solver/sph/constitutive.hpp"
#include "tests/unit/sph/hourglass_motion.hpp"

#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace taylorcal;
using Eigen::Matrix3d;

namespace {

impact::ImpactCase elastic_case() {
    impact::ImpactCase impact_case;
    impact_case.material.equation_of_state = material::EquationOfStateModel::linear;
    impact_case.numerics.grains_per_point = 1;
    return impact_case;
}

/// A small elastic specimen whose deformation is prescribed, the same for all particles.
struct Patch {
    void deform(const Matrix3d& before, const Matrix3d& after, double dt) {
        const Matrix3d rate = (after - before) / dt;
        for (const std::size_t block : packing.active) {
            for (int c = 0; c < 9; ++c) {
                particles.rate[static_cast<std::size_t>(c)][block] =
                    material::broadcast(static_cast<float>(rate(c / 3, c % 3)));
            }
        }
        for (std::size_t index = 0; index < packing.active.size(); ++index) {
            constitutive.update(particles, reference, index, dt);
        }
    }
    double stress(std::size_t component) const {
        const std::size_t block = packing.active.front();
        return static_cast<double>(particles.stress_deviator[component][block][0]);
    }
    double pressure() const {
        return static_cast<double>(particles.pressure[packing.active.front()][0]);
    }

    impact::ImpactCase impact_case = elastic_case();
    sph::Packing packing =
        sph::pack(specimen::make_shape(specimen::uniform_cylinder, 8e-3, 8e-3), 2e-3);
    std::unique_ptr<material::EquationOfState> equation_of_state =
        material::make_equation_of_state(impact_case.material);
    sph::Rest rest = sph::rest_state(*equation_of_state, 300);
    sph::Reference reference{packing, rest.density};
    sph::Particles particles{packing.slots};
    sph::Constitutive constitutive{
        impact_case, packing, *equation_of_state, rest,
        material::make_elastic<float>({}, packing.active.size() * sph::block_size)};
};

}  // namespace

TEST_CASE("a rigid rotation gives no stress", "[constitutive]") {
    Patch patch;
    patch.constitutive.initialise(patch.particles);
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
    constexpr int steps = 400;
    Matrix3d before = Matrix3d::Identity();
    for (int i = 1; i <= steps; ++i) {
        const Matrix3d after =
            Eigen::AngleAxisd(std::numbers::pi * i / steps, axis).toRotationMatrix();
        patch.deform(before, after, 1e-8);
        before = after;
    }
    // Against moduli of 1e11: what single precision leaves.
    for (std::size_t c = 0; c < 6; ++c) CHECK(std::abs(patch.stress(c)) < 1e6);
    CHECK(std::abs(patch.pressure()) < 1e6);
}

TEST_CASE("uniaxial compression gives the elastic stresses and stores its work",
          "[constitutive]") {
    Patch patch;
    patch.constitutive.initialise(patch.particles);
    constexpr double strain = 2e-3;
    constexpr int steps = 100;
    Matrix3d before = Matrix3d::Identity();
    for (int i = 1; i <= steps; ++i) {
        Matrix3d after = Matrix3d::Identity();
        after(2, 2) -= strain * i / steps;
        // Slow enough for the artificial viscosity not to count.
        patch.deform(before, after, 1e-5);
        before = after;
    }
    const double bulk = 138e9, shear = material::shear_modulus(bulk, 0.34);
    CHECK(patch.stress(2) == Approx(-4.0 / 3 * shear * strain).epsilon(5e-3));
    CHECK(patch.stress(0) == Approx(2.0 / 3 * shear * strain).epsilon(5e-3));
    CHECK(patch.pressure() == Approx(bulk * strain).epsilon(5e-3));
    double volume = 0, internal = 0;
    for (std::size_t slot = 0; slot < patch.packing.slots; ++slot) {
        volume += patch.packing.volume[slot];
        if (patch.packing.volume[slot] > 0) {
            internal += patch.rest.density * patch.packing.volume[slot] *
                        patch.particles.energy[slot];
        }
    }
    CHECK(internal == Approx(0.5 * bulk * strain * strain * volume).epsilon(1e-2));
    CHECK(patch.constitutive.work().stored_in_shear ==
          Approx(2.0 / 3 * shear * strain * strain * volume).epsilon(1e-2));
}

TEST_CASE("a misfit is resisted in a narrower lattice as in a body of its size",
          "[constitutive]") {
    const impact::ImpactCase impact_case = elastic_case();
    const sph::Packing packing = sph::pack(
        specimen::make_shape(specimen::reduced_head_3mm, 8e-3, 40e-3), 4e-3 / 5);
    const auto equation_of_state = material::make_equation_of_state(impact_case.material);
    const sph::Rest rest = sph::rest_state(*equation_of_state, 300);
    const sph::Reference reference(packing, rest.density);
    sph::Particles particles(packing.slots);
    sph::Constitutive constitutive(
        impact_case, packing, *equation_of_state, rest,
        material::make_elastic<float>({}, packing.active.size() * sph::block_size));
    constitutive.initialise(particles);
    // a ~ G edge^2 w^2 u / rho ~ u / edge^2.
    set_alternating_speed(particles, packing, 1);
    for (const std::size_t block : packing.active)
        reference.velocity_gradient(particles, block, particles.speed);
    for (std::size_t index = 0; index < packing.active.size(); ++index)
        constitutive.update(particles, reference, index, 1e-9);
    for (const std::size_t block : packing.active) reference.accelerate(particles, block);
    CHECK(scaled_acceleration(particles, packing, 3e-3, 7e-3) ==
          Approx(scaled_acceleration(particles, packing, 25e-3, 35e-3)).epsilon(0.05));
}
