#pragma once

#include "calibrate/prediction/network_predictor.hpp"
#include "common/random.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate::toys {

/// A network of given layers over velocity [100 m/s above 100] and the parameters, each
/// as its place in the unit interval; outputs are the fitted sizes in mm,
/// `covariance` that of the likelihood. `roots`: of
/// those that are uniform from 0 or above, the square root.
inline NetworkPredictor network(const Settings& settings,
                                const std::vector<emulator::Layer>& layers,
                                const Eigen::MatrixXd& covariance, bool roots = false) {
    using emulator::Transform;
    emulator::Model model;
    model.inputs.push_back({"velocity_m_s", Transform::linear, 50, 200, 100, 100, true});
    for (const Parameter& p : settings.parameters) {
        const Transform transform = p.log_uniform           ? Transform::log10
                                    : roots && p.lower >= 0 ? Transform::square_root
                                                            : Transform::linear;
        const double low = emulator::transformed(transform, p.lower);
        const double high = emulator::transformed(transform, p.upper);
        model.inputs.push_back(
            {p.name, transform, p.lower, p.upper, low, high - low, true});
    }
    for (const std::string& size : settings.fit_sizes)
        model.outputs.push_back({size, 0, 1, {}});
    model.members.push_back({layers, 1, 16, 0.01, 0.1});
    model.covariances = {{"all", {settings.fit_sizes, covariance / held_out_understate}}};
    return {emulator::Emulator(std::move(model)), settings};
}

/// sizes = weights (velocity, parameters) + bias.
inline std::vector<emulator::Layer> linear_layer(const Eigen::MatrixXd& weights,
                                                 const Eigen::VectorXd& bias) {
    return {{weights.cast<float>(), bias.cast<float>()}};
}

/// A network with random weights and hidden layers of 21 neurons as the paper's.
inline std::vector<emulator::Layer> random_layers(Eigen::Index inputs,
                                                  Eigen::Index outputs,
                                                  std::uint64_t seed) {
    std::vector<emulator::Layer> layers;
    const RandomStream random(seed, 5);
    std::uint64_t counter = 0;
    constexpr int hidden = 7;
    constexpr Eigen::Index neurons = 21;
    for (int i = 0; i <= hidden; ++i) {
        const Eigen::Index columns = i == 0 ? inputs : neurons;
        const Eigen::Index rows = i == hidden ? outputs : neurons;
        emulator::Layer layer{Eigen::MatrixXf(rows, columns), Eigen::VectorXf(rows)};
        const double size =
            (i == 0 ? 1.5 : 1.7) / std::sqrt(static_cast<double>(columns));
        for (float& weight : layer.weights.reshaped())
            weight = static_cast<float>(size * random.normal(counter++));
        for (float& bias : layer.bias)
            bias = static_cast<float>(0.3 * random.normal(counter++));
        layers.push_back(std::move(layer));
    }
    return layers;
}

}  // namespace taylorcal::calibrate::toys
