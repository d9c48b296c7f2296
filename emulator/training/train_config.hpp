#pragma once

#include "emulator/inference/model.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace taylorcal::emulator {

struct InputChoice {
    std::string name;
    Transform transform = Transform::linear;
};

struct OutputChoice {
    std::string name;
    std::vector<std::string> divide_by;
};

/// What train.json says.
struct TrainConfig {
    std::vector<InputChoice> inputs;
    std::string category;  ///< Name of a dataset of texts; empty for none.
    std::vector<OutputChoice> outputs;
    int hidden_layers = 7;
    int neurons = 0;  ///< Of each hidden layer; 0 = 4 N + 1 for N inputs that vary.
    int members = 4;
    int epochs = 3000;
    std::vector<int> batch_sizes = {32};
    std::vector<double> learning_rates = {1e-2};
    double weight_decay = 0.1;  ///< At the start; falls to zero. 0 for exact data.
    double validation_fraction = 0.15;
    std::uint64_t seed = 1;
    nlohmann::json as_given;
};

TrainConfig read_train_config(const std::filesystem::path& path);
TrainConfig train_config_from_json(const nlohmann::json& file, const std::string& where);

}  // namespace taylorcal::emulator
