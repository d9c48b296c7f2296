#include "common/specimen_names.hpp"
#include "solver/sph/reference.hpp"
#include "tests/unit/sph/hourglass_motion.hpp"

#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace taylorcal;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

sph::Packing specimen_packing(int kind) {
    return sph::pack(specimen::make_shape(
                         specimen::profile_named(paper_shapes().at(kind)), 8e-3, 40e-3),
                     1e-3);
}

void set_linear_velocity(sph::Particles& particles, const sph::Packing& packing,
                         const Matrix3d& gradient) {
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        if (packing.volume[slot] <= 0) continue;
        const Vector3d v =
            gradient * Vector3d(packing.x[slot], packing.y[slot], packing.z[slot]);
        for (std::size_t c = 0; c < 3; ++c) {
            particles.speed[c].lanes()[slot] =
                static_cast<float>(v(static_cast<Eigen::Index>(c)));
        }
    }
}

}  // namespace

TEST_CASE("a linear velocity field has its exact gradient everywhere", "[reference]") {
    const sph::Packing packing = specimen_packing(GENERATE(0, 1, 2, 3));
    const sph::Reference reference(packing, 8930);
    sph::Particles particles(packing.slots);
    Matrix3d gradient;
    gradient << 1e3, -2e3, 500, 700, 3e3, -900, 400, 100, -4e3;
    set_linear_velocity(particles, packing, gradient);
    for (const std::size_t block : packing.active) {
        reference.velocity_gradient(particles, block, particles.speed);
    }
    double largest = 0, misfit = 0;
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        if (packing.volume[slot] <= 0) continue;
        for (std::size_t c = 0; c < 9; ++c) {
            const double rate = static_cast<double>(particles.rate[c].lanes()[slot]);
            const auto row = static_cast<Eigen::Index>(c / 3);
            const auto column = static_cast<Eigen::Index>(c % 3);
            largest = std::max(largest, std::abs(rate - gradient(row, column)));
        }
        for (const sph::Field& field : particles.misfit_rate) {
            misfit = std::max(misfit, std::abs(static_cast<double>(field.lanes()[slot])));
        }
    }
    CHECK(largest < 1e-3 * gradient.norm());
    CHECK(misfit < 1e-3 * gradient.norm() / packing.edge);
}

TEST_CASE("the misfit sees bulging much less than hourglass motion", "[reference]") {
    const sph::Packing packing = specimen_packing(GENERATE(0, 1, 2, 3));
    const sph::Reference reference(packing, 8930);
    sph::Particles particles(packing.slots);
    const auto mean_square = [&] {
        for (const std::size_t block : packing.active)
            reference.velocity_gradient(particles, block, particles.speed);
        double sum = 0;
        for (std::size_t slot = 0; slot < packing.slots; ++slot) {
            const double edge = packing.local_edge[slot];
            const double rate =
                static_cast<double>(particles.misfit_rate[0].lanes()[slot]);
            if (packing.volume[slot] > 0) sum += std::pow(edge * edge * rate, 2);
        }
        return sum;
    };
    // Second differences of 10 m/s along the axis, between edges.
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        const double z = packing.z[slot] / packing.local_edge[slot];
        if (packing.volume[slot] > 0)
            particles.speed[0].lanes()[slot] = static_cast<float>(5 * z * z);
    }
    const double bulging = mean_square();
    set_alternating_speed(particles, packing, 10);
    CHECK(bulging < 0.01 * mean_square());
}

TEST_CASE("a uniform axial stress pulls at the faces alone", "[reference]") {
    const sph::Packing packing = sph::pack(
        specimen::make_shape(specimen::uniform_cylinder, 8e-3, 40e-3), 4e-3 / 6);
    const sph::Reference reference(packing, 8930);
    sph::Particles particles(packing.slots);
    sph::Vector stress[9] = {};
    stress[8] = sph::Vector(-1e8f);
    for (const std::size_t block : packing.active) {
        reference.store_pull(particles, block, stress);
    }
    for (const std::size_t block : packing.active) reference.accelerate(particles, block);
    std::vector<double> force(packing.layers.size());
    for (std::size_t c = 0; c < packing.columns.size(); ++c) {
        for (std::size_t k = 0; k < packing.sites_per_column; ++k) {
            const std::size_t slot = packing.columns[c].first_slot + k;
            if (packing.volume[slot] <= 0) continue;
            force[packing.layer_of(c, k)] +=
                8930 * packing.volume[slot] *
                static_cast<double>(particles.acceleration[2].lanes()[slot]);
        }
    }
    const double whole = 1e8 * std::numbers::pi * 16e-6;
    CHECK(force.front() == Approx(-whole).epsilon(0.02));
    CHECK(force.back() == Approx(whole).epsilon(0.02));
    for (std::size_t l = 1; l + 1 < force.size(); ++l)
        CHECK(std::abs(force[l]) < 0.03 * whole);
}

TEST_CASE("pair forces add up to nothing", "[reference]") {
    const sph::Packing packing = specimen_packing(3);
    const sph::Reference reference(packing, 8930);
    sph::Particles particles(packing.slots);
    // Any stress and velocity field will do: here one without symmetry.
    for (const std::size_t block : packing.active) {
        sph::Vector stress[9];
        for (int c = 0; c < 9; ++c) {
            for (std::size_t k = 0; k < sph::block_size; ++k) {
                const double z = packing.z[block * sph::block_size + k];
                stress[c][k] = static_cast<float>(1e8 * std::sin(900 * z + c));
            }
        }
        reference.store_pull(particles, block, stress);
    }
    for (const std::size_t block : packing.active) {
        reference.accelerate(particles, block);
    }
    for (const sph::Field& field : particles.acceleration) {
        double force = 0, scale = 0;
        for (std::size_t slot = 0; slot < packing.slots; ++slot) {
            const double f =
                packing.volume[slot] * static_cast<double>(field.lanes()[slot]);
            force += f;
            scale += std::abs(f);
        }
        CHECK(scale > 0);
        CHECK(std::abs(force) < 1e-5 * scale);
    }
}

TEST_CASE("pulls against the misfit do their work on it, and push nothing away",
          "[reference]") {
    const sph::Packing packing = specimen_packing(GENERATE(1, 3));
    const sph::Reference reference(packing, 8930);
    sph::Particles particles(packing.slots);
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        if (packing.volume[slot] <= 0) continue;
        const double phase =
            4e3 * packing.x[slot] - 3e3 * packing.y[slot] + 5e3 * packing.z[slot];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto shift = static_cast<double>(c);
            particles.speed[c].lanes()[slot] =
                static_cast<float>(10 * std::sin(phase + shift));
            particles.misfit_pull[c].lanes()[slot] =
                static_cast<float>(1e5 * std::cos(2 * phase - shift));
        }
    }
    const sph::Vector unstressed[9] = {};
    for (const std::size_t block : packing.active) {
        reference.velocity_gradient(particles, block, particles.speed);
        reference.store_pull(particles, block, unstressed);
    }
    for (const std::size_t block : packing.active) reference.accelerate(particles, block);
    double power = 0, work = 0, scale = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        double force = 0, forces = 0;
        for (std::size_t slot = 0; slot < packing.slots; ++slot) {
            const auto of = [&](const std::array<sph::Field, 3>& field) {
                return static_cast<double>(field[c].lanes()[slot]);
            };
            const double volume = packing.volume[slot];
            if (volume <= 0) continue;
            power += volume * of(particles.misfit_pull) * of(particles.misfit_rate);
            const double pushed = 8930 * volume * of(particles.acceleration);
            work -= pushed * of(particles.speed);
            scale += std::abs(pushed * of(particles.speed));
            force += pushed;
            forces += std::abs(pushed);
        }
        CHECK(std::abs(force) < 1e-5 * forces);
    }
    CHECK(std::abs(work - power) < 1e-5 * scale);
    CHECK(std::abs(power) > 1e-3 * scale);
}
