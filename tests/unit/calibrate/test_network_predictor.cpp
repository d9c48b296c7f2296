#include "calibrate/prediction/network_predictor.hpp"
#include "common/errors.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;

namespace {

using emulator::InputInfo;
using emulator::Transform;

/// One hidden layer of two neurons over velocity, ratio and log10 of the density.
emulator::Model small_network() {
    emulator::Model model;
    model.inputs = {{"velocity_m_s", Transform::linear, 100, 200, 150, 50, true},
                    {"initial_diameter_mm", Transform::linear, 8, 8, 8, 1, false},
                    {"length_to_diameter", Transform::linear, 2, 6, 4, 2, true},
                    {"initial_temperature_K", Transform::linear, 295, 295, 295, 1, false},
                    {"rho_immobile_initial", Transform::log10, 1e10, 1e15, 12, 2, true}};
    model.category = {"shape", {"uniform_cylinder"}};
    model.outputs = {
        {"final_length_mm", 0.7, 0.1, {"initial_diameter_mm", "length_to_diameter"}},
        {"impact_diameter_mm", 1.4, 0.2, {"initial_diameter_mm"}}};
    emulator::Member member;
    member.layers.resize(2);
    member.layers[0].weights.resize(2, 4);  // the last input is the one-hot shape
    member.layers[0].weights << 0.5f, -0.3f, 0.2f, 0.1f, -0.4f, 0.1f, 0.6f, -0.2f;
    member.layers[0].bias = Eigen::VectorXf::Constant(2, 0.05f);
    member.layers[1].weights.resize(2, 2);
    member.layers[1].weights << 1.0f, -0.5f, 0.3f, 0.8f;
    member.layers[1].bias = Eigen::VectorXf::Zero(2);
    model.members = {member};
    emulator::Covariance covariance;
    covariance.outputs = {"final_length_mm", "impact_diameter_mm"};
    covariance.matrix.resize(2, 2);
    covariance.matrix << 1e-4, 2e-5, 2e-5, 4e-4;
    model.covariances = {{"uniform_cylinder", covariance}};
    return model;
}

Settings settings_of(double lower, double upper) {
    Settings settings;
    settings.parameters = {{"rho_immobile_initial", lower, upper, true, true}};
    // The other way round than in the network.
    settings.fit_sizes = {"impact_diameter_mm", "final_length_mm"};
    return settings;
}

NetworkPredictor predictor() {
    return NetworkPredictor(emulator::Emulator(small_network()), settings_of(1e10, 1e15));
}

DataSet data_of(const Shot& shot) {
    return make_data_set({shot}, {"impact_diameter_mm", "final_length_mm"});
}

Shot good_shot() { return toys::shot("a", "one", 150, {{"final_length_mm", 30, 0.2}}); }

std::string complaint(const Shot& shot) {
    try {
        predictor().check_ranges(data_of(shot));
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("the network is asked for the shot and the parameters", "[network]") {
    Shot shot = good_shot();
    shot.velocity_m_s = 175;
    RowMatrix parameters(2, 1);
    parameters << 1e11, 3e13;
    const RowMatrix found = predictor().predict(shot, parameters);
    for (Eigen::Index i = 0; i < 2; ++i) {
        const double z[] = {0.5, 0.5, (std::log10(parameters(i, 0)) - 12) / 2};
        const auto silu = [](double x) { return x / (1 + std::exp(-x)); };
        const double a = silu(0.5 * z[0] - 0.3 * z[1] + 0.2 * z[2] + 0.1 + 0.05);
        const double b = silu(-0.4 * z[0] + 0.1 * z[1] + 0.6 * z[2] - 0.2 + 0.05);
        CHECK(found(i, 1) == Approx((0.7 + 0.1 * (a - 0.5 * b)) * 40).epsilon(1e-5));
        CHECK(found(i, 0) == Approx((1.4 + 0.2 * (0.3 * a + 0.8 * b)) * 8).epsilon(1e-5));
    }
}

TEST_CASE("the network's covariance is scaled by the specimen", "[network]") {
    const Eigen::VectorXd density = Eigen::VectorXd::Constant(1, 1e12);
    const Eigen::MatrixXd covariance = predictor().error_covariance(good_shot(), density);
    CHECK(covariance(0, 0) == Approx(3 * 4e-4 * 8 * 8));
    CHECK(covariance(1, 1) == Approx(3 * 1e-4 * 40 * 40));
    CHECK(covariance(0, 1) == Approx(3 * 2e-5 * 8 * 40));
}

TEST_CASE("the network's covariance is that of the held-out runs next to the metal",
          "[network]") {
    // Soft metal (log10 rho = 10) is off by ten times as much as hard metal (15).
    emulator::Model model = small_network();
    const auto rows = 2 * emulator::neighbours;
    model.held_out.places = Eigen::MatrixXd::Zero(rows, 3);
    model.held_out.errors.resize(rows, 2);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const bool soft = i < emulator::neighbours;
        model.held_out.categories.emplace_back("uniform_cylinder");
        model.held_out.places(i, 2) = soft ? -1 : 1.5;
        model.held_out.errors.row(i) << (i % 2 ? 1 : -1) * (soft ? 0.05 : 0.005), 0.01;
    }
    const NetworkPredictor near(emulator::Emulator(model), settings_of(1e10, 1e15));
    const double weight = 1.0 / (emulator::neighbours + 1);
    const auto of = [&](double density) {
        return near.error_covariance(good_shot(), Eigen::VectorXd::Constant(1, density));
    };
    const auto blended = [&](double own, double whole) {
        return (1 - weight) * own + weight * whole;
    };
    CHECK(of(1e10)(1, 1) == Approx(3 * 1600 * blended(2.5e-3, 1e-4)));
    CHECK(of(1e15)(1, 1) == Approx(3 * 1600 * blended(2.5e-5, 1e-4)));
    CHECK(of(1e15)(0, 0) == Approx(3 * 64 * blended(1e-4, 4e-4)));
    CHECK(of(1e15)(0, 1) == Approx(3 * 320 * weight * 2e-5));
}

TEST_CASE("shots beyond the network are refused", "[network]") {
    CHECK(complaint(good_shot()) == "no error");
    Shot shot = good_shot();
    SECTION("velocity") {
        shot.velocity_m_s = 250;
        CHECK_THAT(complaint(shot), Contains("shot a") &&
                                        Contains("velocity_m_s = 250") &&
                                        Contains("100 to 200") &&
                                        Contains("study.yaml") && Contains("ignore"));
    }
    SECTION("the place in the table is told") {
        shot.velocity_m_s = 250;
        shot.place = "measurements.csv, line 3";
        CHECK_THAT(complaint(shot), Contains("measurements.csv, line 3, shot a: "));
    }
    SECTION("length/diameter") {
        shot.initial_length_mm = 80;
        CHECK_THAT(complaint(shot), Contains("length_to_diameter = 10"));
    }
    SECTION("a constant input may differ a little") {
        shot.initial_temperature_K = 300;
        CHECK(complaint(shot) == "no error");
        shot.initial_temperature_K = 400;
        CHECK_THAT(complaint(shot), Contains("initial_temperature_K"));
    }
    SECTION("shape") {
        shot.shape = "truncated_cone";
        CHECK_THAT(complaint(shot), Contains("truncated_cone"));
    }
    SECTION("held-back shots too, ignored ones not") {
        shot.velocity_m_s = 250;
        shot.use = Use::ignore;
        CHECK_NOTHROW(predictor().check_ranges(
            make_data_set({good_shot(), shot}, {"final_length_mm"})));
    }
}

TEST_CASE("settings that the network cannot serve are refused", "[network]") {
    const emulator::Emulator network(small_network());
    CHECK_THROWS_WITH(NetworkPredictor(network, settings_of(1e8, 1e15)),
                      Contains("rho_immobile_initial") && Contains("study.yaml"));
    Settings settings = settings_of(1e10, 1e15);
    settings.parameters[0].name = "rho_immobile";
    CHECK_THROWS_WITH(NetworkPredictor(network, settings),
                      Contains("rho_immobile_initial"));
    settings = settings_of(1e10, 1e15);
    settings.fit_sizes = {"head_length_mm"};
    CHECK_THROWS_AS(NetworkPredictor(network, settings), InputError);
    settings = settings_of(1e10, 1e15);
    settings.parameters[0] = {"velocity_m_s", 100, 200, false, false};
    CHECK_THROWS_WITH(NetworkPredictor(network, settings), Contains("measurement table"));
}

TEST_CASE("a network of one shape without category refuses others", "[network]") {
    emulator::Model model = small_network();
    Eigen::MatrixXf& weights = model.members[0].layers[0].weights;
    weights = Eigen::MatrixXf(weights.leftCols(3));
    model.category = {};
    Shot cone = good_shot();
    cone.shape = "truncated_cone";
    const auto check = [&] {
        const NetworkPredictor network(emulator::Emulator(model),
                                       settings_of(1e10, 1e15));
        network.check_ranges(data_of(cone));
    };
    CHECK_NOTHROW(check());  // as files of before, which do not tell their shape
    model.only_shape = "uniform_cylinder";
    CHECK_THROWS_WITH(check(), Contains("shot a: ") &&
                                   Contains("the shape uniform_cylinder only") &&
                                   Contains("\"truncated_cone\""));
    cone.shape = "uniform_cylinder";
    CHECK_NOTHROW(check());
}
