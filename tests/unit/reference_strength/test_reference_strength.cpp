#include "solver/material/elastic.hpp"
#include "solver/material/j2.hpp"
#include "solver/material/johnson_cook.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace taylorcal::material;
using Eigen::Matrix3d;

namespace {

constexpr double shear = 45e9;

/// Drives every lane of block 0 with one velocity gradient; returns S of `lane`.
struct Driver {
    std::unique_ptr<Strength<double>> strength;
    double temperature = 300;
    double plastic_work = 0;  // [J/m3]

    Matrix3d step(const Matrix3d& gradient, double dt, std::size_t lane = 3) {
        BlockInput<double> input;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                input.velocity_gradient[3 * i + j] = broadcast(gradient(i, j));
            }
        }
        input.density = broadcast(8930.0);
        input.temperature = broadcast(temperature);
        input.shear_modulus = broadcast(shear);
        input.time_step = dt;
        BlockOutput<double> output;
        strength->update(0, input, output);
        plastic_work += output.plastic_power[lane] * dt;
        const auto s = [&](int c) { return output.stress_deviator[c][lane]; };
        Matrix3d stress;
        stress << s(0), s(3), s(4), s(3), s(1), s(5), s(4), s(5), s(2);
        return stress;
    }
    Matrix3d steps(const Matrix3d& gradient, double dt, int n) {
        Matrix3d stress;
        for (int i = 0; i < n; ++i) stress = step(gradient, dt);
        return stress;
    }
};

double von_mises(const Matrix3d& s) { return std::sqrt(1.5 * (s * s).trace()); }

Matrix3d compression(double rate) {
    return Eigen::Vector3d(0.5 * rate, 0.5 * rate, -rate).asDiagonal();
}

Matrix3d spin(double rate, const Eigen::Vector3d& axis) {
    const Eigen::Vector3d w = rate * axis.normalized();
    Matrix3d m;
    m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    return m;
}

}  // namespace

TEST_CASE("the elastic deviator follows Hooke's law", "[elastic]") {
    Driver driver{make_elastic<double>({}, 5)};
    Matrix3d gradient;
    gradient << 1, 4, -2, 0, 3, 5, 6, 1, 2;
    const Matrix3d stress = driver.step(gradient, 1e-7);
    const Matrix3d rate = 0.5 * (gradient + gradient.transpose());
    const Matrix3d expected =
        2 * shear * 1e-7 * (rate - rate.trace() / 3 * Matrix3d::Identity());
    CHECK((stress - expected).norm() < 1e-5 * expected.norm());
    CHECK(driver.strength->state(3).elastic_shear_energy_J_m3 ==
          Approx((stress * stress).trace() / (4 * shear)));
    CHECK(driver.plastic_work == 0);
}

TEST_CASE("a rigid rotation turns the stress and changes no invariant", "[elastic]") {
    const Eigen::Vector3d axis(1, 2, -0.5);
    for (const int steps : {4, 400}) {
        Driver driver{make_elastic<double>({}, 16)};
        const Matrix3d before = driver.step(compression(1e4), 1e-8);
        // The Cayley map turns by 2 atan(angle/2) a step: aim at a quarter turn exactly.
        const double angle = std::numbers::pi / 2 / steps;
        const Matrix3d after =
            driver.steps(spin(2 * std::tan(angle / 2) / 1e-8, axis), 1e-8, steps);
        const Matrix3d turn =
            Eigen::AngleAxisd(std::numbers::pi / 2, axis.normalized()).toRotationMatrix();
        CHECK((after - turn * before * turn.transpose()).norm() < 1e-10 * before.norm());
    }
}

TEST_CASE("J2 follows the hardening line and dissipates its stress times strain",
          "[j2]") {
    Parameters parameters;
    parameters.j2_yield_stress = 400e6;
    parameters.j2_hardening_modulus = 100e6;
    Driver driver{make_j2<double>(parameters, 16)};
    const double rate = 1e4, dt = 1e-8;
    const int n = 5000;
    const double total = rate * dt * n;
    const double q = von_mises(driver.steps(compression(rate), dt, n));
    // Strain splits into q/3G elastic and the rest plastic.
    const double plastic = (total - 400e6 / (3 * shear)) / (1 + 100e6 / (3 * shear));
    CHECK(q == Approx(400e6 + 100e6 * plastic).epsilon(1e-9));
    CHECK(driver.strength->state(3).equivalent_plastic_strain == Approx(plastic));
    CHECK(driver.strength->state(3).slip_resistance_Pa == Approx(q));
    CHECK(driver.plastic_work ==
          Approx(400e6 * plastic + 50e6 * plastic * plastic).epsilon(1e-4));
}

TEST_CASE("J2 in float agrees with double", "[j2]") {
    auto single = make_j2<float>({}, 16);
    Driver driver{make_j2<double>({}, 16)};
    Matrix3d gradient;
    gradient << 1e4, 3e4, 0, -1e4, 2e3, 5e3, 0, 7e3, -1.2e4;
    const Matrix3d stress = driver.steps(gradient, 1e-8, 2000);
    BlockInput<float> input;
    for (int i = 0; i < 9; ++i) {
        input.velocity_gradient[i] =
            broadcast(static_cast<float>(gradient(i / 3, i % 3)));
    }
    input.temperature = broadcast(300.0f);
    input.density = broadcast(8930.0f);
    input.shear_modulus = broadcast(static_cast<float>(shear));
    input.time_step = 1e-8f;
    BlockOutput<float> output;
    for (int i = 0; i < 2000; ++i) single->update(0, input, output);
    CHECK(static_cast<double>(output.stress_deviator[0][7]) ==
          Approx(stress(0, 0)).epsilon(1e-3));
    CHECK(static_cast<double>(output.stress_deviator[3][7]) ==
          Approx(stress(0, 1)).epsilon(1e-3));
}

TEST_CASE("Johnson-Cook gives its own formula in steady compression", "[johnson_cook]") {
    const Parameters p;
    const double temperature = GENERATE(300.0, 600.0, 1100.0);
    const double rate = GENERATE(1e2, 1e5);
    Driver driver{make_johnson_cook<double>(p, 16), temperature};
    const double dt = 1e-4 / rate;
    const double q = von_mises(driver.steps(compression(rate), dt, 3000));
    const double strain = driver.strength->state(3).equivalent_plastic_strain;
    const double expected = (p.jc_a + p.jc_b * std::pow(strain, p.jc_n)) *
                            (1 + p.jc_c * std::log(rate)) *
                            (1 - std::pow((temperature - 300) / (1356 - 300), p.jc_m));
    CHECK(strain == Approx(0.3).epsilon(0.02));
    CHECK(q == Approx(expected).epsilon(1e-3));
}

TEST_CASE("Johnson-Cook has no strength at melting", "[johnson_cook]") {
    Driver driver{make_johnson_cook<double>({}, 16), 1400};
    const Matrix3d stress = driver.steps(compression(1e4), 1e-8, 50);
    CHECK(von_mises(stress) < 1e3);
}
