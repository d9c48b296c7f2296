#include "calibrate/posterior/weighted_quantile.hpp"
#include "calibrate/sampling/draw_pool.hpp"
#include "calibrate/sampling/heavy_tail.hpp"
#include "calibrate/sampling/log_sum.hpp"
#include "common/random.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;

TEST_CASE("effective size is (sum w)^2 / sum w^2, in blocks too", "[draws]") {
    const double weights[] = {0.2, 3.0, 1.1, 0.0, 7.5, 0.4};
    double sum = 0, squares = 0;
    LogSum all, first, second;
    for (int i = 0; i < 6; ++i) {
        sum += weights[i];
        squares += weights[i] * weights[i];
        all.add(std::log(weights[i]) - 900);  // far below the smallest double
        (i < 2 ? first : second).add(std::log(weights[i]) - 900);
    }
    first.merge(second);
    CHECK(all.effective_size() == Approx(sum * sum / squares));
    CHECK(first.effective_size() == Approx(sum * sum / squares));
    CHECK(first.value() == Approx(std::log(sum) - 900));
    CHECK(LogSum().effective_size() == 0);
}

TEST_CASE("Student's t with four degrees of freedom", "[draws]") {
    // Tabulated quantiles, e.g. Abramowitz and Stegun table 26.10.
    CHECK(t4_quantile(0.975) == Approx(2.776).epsilon(2e-4));
    CHECK(t4_quantile(0.95) == Approx(2.132).epsilon(3e-4));
    CHECK(t4_quantile(0.5) == Approx(0).margin(1e-7));
    CHECK(t4_quantile(0.1) == Approx(-t4_quantile(0.9)));
    double mass = 0;
    const double step = 1e-3;
    for (double z = -50; z < t4_quantile(0.8); z += step)
        mass += std::exp(t4_log_density(z + 0.5 * step)) * step;
    CHECK(mass == Approx(0.8).epsilon(1e-3));
}

TEST_CASE("a mixture draws from the density that it states", "[draws]") {
    // Importance sampling of the unit cube's volume under the mixture must give one.
    Eigen::MatrixXd root(2, 2);
    root << 0.05, 0, 0.03, 0.02;
    Eigen::VectorXd a(2), b(2);
    a << 0.3, 0.7;
    b << 0.9, 0.1;
    const Mixture mixture(0.1, {0.3, 0.6}, {HeavyTail(a, root), HeavyTail(b, 2 * root)});
    const RandomStream x(5, 1), y(5, 2);
    double sum = 0, squares = 0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        Eigen::VectorXd uniforms(2);
        const auto k = static_cast<std::uint64_t>(i);
        uniforms << x.uniform(k), y.uniform(k);
        const Eigen::VectorXd point = mixture.draw(uniforms);
        if (!in_unit_cube(point)) continue;
        const double weight = std::exp(-mixture.log_density(point));
        sum += weight;
        squares += weight * weight;
    }
    const double mean = sum / count;
    const double error = std::sqrt((squares / count - mean * mean) / count);
    CHECK(error < 0.02);
    CHECK(std::abs(mean - 1) < 4 * error);
}

TEST_CASE("the pool keeps weighted sums whatever the order", "[draws]") {
    const RandomStream uniform(9, 1);
    constexpr std::uint64_t count = 20000;
    const auto draw = [&](std::uint64_t i) {
        const double u = uniform.uniform(3 * i);
        const double log_weight = 3 * uniform.normal(3 * i + 1);
        return ChosenDraw{i, log_weight,
                          log_weight - std::log(uniform.uniform(3 * i + 2)),
                          Eigen::VectorXd::Constant(1, u), i % 3};
    };
    DrawPool forward(2000), backward(2000);
    double sum = 0, total = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        forward.add({draw(i)});
        backward.add({draw(count - 1 - i)});
        const double weight = std::exp(draw(i).log_weight);
        sum += weight * draw(i).unit(0);
        total += weight;
    }
    const WeightedDraws kept = forward.weighted();
    const WeightedDraws other = backward.weighted();
    REQUIRE(kept.weights.size() == 2000);
    CHECK(kept.units == other.units);
    CHECK(kept.weights == other.weights);
    CHECK(kept.levels == other.levels);
    CHECK(kept.units.col(0).dot(kept.weights) == Approx(sum / total).margin(0.01));

    const WeightedDraws equal = resample(kept, 5000, 0.37);
    CHECK(equal.units.col(0).mean() ==
          Approx(kept.units.col(0).dot(kept.weights)).margin(4e-3));
}

TEST_CASE("weighted quantiles", "[draws]") {
    Eigen::VectorXd values(4), weights(4);
    values << 4, 1, 3, 2;
    weights << 1, 1, 1, 1;
    CHECK(WeightedQuantile(values, weights)(0.5) == Approx(2.5));
    weights << 0, 1, 0, 3;  // 1 once, 2 three times
    CHECK(WeightedQuantile(values, weights)(0.9) > 1.9);
    CHECK(WeightedQuantile(values, weights)(0.05) == Approx(1));
}
