#include "emulator/training/network.hpp"

#include "emulator/training/adam.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal::emulator;
using DoubleNetwork = Network<double>;

namespace {

struct Case {
    DoubleNetwork::Block inputs = DoubleNetwork::Block::Random(3, 5);
    DoubleNetwork::Block targets = DoubleNetwork::Block::Random(2, 5);
    DoubleNetwork::Block mask = DoubleNetwork::Block::Ones(2, 5);
};

}  // namespace

TEST_CASE("the gradient is the derivative of the error", "[network]") {
    Case data;
    data.mask(0, 1) = data.mask(1, 4) = 0;
    DoubleNetwork network({3, 6, 5, 4, 2}, 7);
    network.parameters() += 0.1;  // Biases that are not zero.
    network.backward(data.inputs, data.targets, data.mask);
    const DoubleNetwork::Vector gradient = network.gradient();
    REQUIRE(gradient.abs().maxCoeff() > 1e-3);
    for (Eigen::Index i = 0; i < gradient.size(); ++i) {
        const double step = 1e-5;
        const double kept = network.parameters()[i];
        network.parameters()[i] = kept + step;
        const double above = network.backward(data.inputs, data.targets, data.mask);
        network.parameters()[i] = kept - step;
        const double below = network.backward(data.inputs, data.targets, data.mask);
        network.parameters()[i] = kept;
        CHECK(gradient[i] ==
              Approx((above - below) / (2 * step)).epsilon(1e-6).margin(1e-9));
    }
}

TEST_CASE("a masked output has no influence", "[network]") {
    Case data;
    data.mask(1, 2) = 0;
    DoubleNetwork network({3, 6, 2}, 1);
    const double error = network.backward(data.inputs, data.targets, data.mask);
    const DoubleNetwork::Vector gradient = network.gradient();
    data.targets(1, 2) = 1e6;
    CHECK(network.backward(data.inputs, data.targets, data.mask) == error);
    CHECK((network.gradient() == gradient).all());
    data.targets(1, 1) += 1;
    CHECK(network.backward(data.inputs, data.targets, data.mask) != error);
}

TEST_CASE("a signal keeps its size through seven SiLU layers", "[network]") {
    const std::vector<Eigen::Index> widths = {8, 29, 29, 29, 29, 29, 29, 29, 7};
    double mean_square = 0;
    constexpr int networks = 50;
    for (int seed = 0; seed < networks; ++seed) {
        DoubleNetwork network(widths, static_cast<std::uint64_t>(seed));
        // Uniform on (-1, 1), times sqrt(3): variance one.
        const DoubleNetwork::Block inputs =
            std::sqrt(3.0) * DoubleNetwork::Block::Random(8, 64);
        mean_square += network.forward(inputs).square().mean() / networks;
    }
    // Without its account of SiLU the start would lose a factor 0.36^7 = 7e-4.
    CHECK(mean_square > 0.25);
    CHECK(mean_square < 4);
}

// f = (p - 3)^2 from p = 1 with rate 0.1: moments and steps worked out by hand from
// algorithm 1 of Kingma and Ba. The first step is the rate times the gradient's sign;
// with gradients -4 and -3.8 the second is 0.1 (0.1 * -3.8 + 0.09 * -4) / 0.19 over
// sqrt((0.001 * 3.8^2 + 0.000999 * 4^2) / 0.001999).
TEST_CASE("Adam takes the steps worked out by hand", "[adam]") {
    Adam<double> adam(1);
    Eigen::ArrayXd p(1), gradient(1);
    const Eigen::ArrayXd no_decay = Eigen::ArrayXd::Zero(1);
    p << 1;
    gradient << 2 * (p[0] - 3);
    adam.step(p, gradient, 0.1, no_decay);
    CHECK(p[0] == Approx(1.1).epsilon(1e-8));
    gradient << 2 * (p[0] - 3);
    adam.step(p, gradient, 0.1, no_decay);
    const double mean = (0.1 * -3.8 + 0.09 * -4) / 0.19;
    const double square = (0.001 * 3.8 * 3.8 + 0.000999 * 4 * 4) / 0.001999;
    CHECK(p[0] == Approx(1.1 - 0.1 * mean / std::sqrt(square)).epsilon(1e-7));
}

TEST_CASE("weight decay shrinks what it is told to", "[adam]") {
    Adam<double> adam(2);
    Eigen::ArrayXd p(2), decay(2);
    p << 2, 2;
    decay << 0.5, 0;
    adam.step(p, Eigen::ArrayXd::Zero(2), 0.1, decay);
    CHECK(p[0] == Approx(2 * (1 - 0.1 * 0.5)));
    CHECK(p[1] == 2);
}
