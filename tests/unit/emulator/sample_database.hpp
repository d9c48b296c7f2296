#pragma once

#include "common/hdf5_file.hpp"
#include "common/random.hpp"
#include "emulator/training/dataset.hpp"
#include "emulator/training/train_config.hpp"

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

namespace taylorcal::testing {

/// A known smooth function of speed (linear), density (by its logarithm), size and a
/// word; "ratio" has no meaning for the word "plain".
struct KnownFunction {
    static double length(double speed, double density, double size, bool plain) {
        return size * (1 - 0.3 * speed * speed / (1 + 0.2 * std::log10(density))) +
               (plain ? 0 : 0.05 * size * speed);
    }
    static double ratio(double speed, double density) {
        return 1 + 0.5 * std::tanh(speed) + 0.02 * std::log10(density);
    }
};

/// `rows` rows of it, as the database contract says; run 2 failed.
inline void write_sample_database(const std::filesystem::path& path, int rows,
                                  std::uint64_t seed = 5) {
    const RandomStream random(seed, 77);
    RowMatrix inputs(rows, 4), outputs(rows, 2);
    std::vector<std::int64_t> ids, status;
    std::vector<std::string> words;
    for (int i = 0; i < rows; ++i) {
        const auto number = [&](int k) {
            return random.uniform(static_cast<std::uint64_t>(4 * i + k));
        };
        const double speed = number(0), density = std::pow(10.0, 10 + 5 * number(1));
        const double size = 5 + 5 * number(2);
        const bool plain = number(3) < 0.5;
        inputs.row(i) << speed, density, 294, size;
        outputs.row(i) << KnownFunction::length(speed, density, size, plain),
            plain ? std::nan("") : KnownFunction::ratio(speed, density);
        ids.push_back(i);
        status.push_back(i == 2 ? 2 : 0);
        words.push_back(plain ? "plain" : "curved");
    }
    Hdf5Writer file(path);
    file.attribute("schema", "taylorcal/database/1");
    file.integers("run_id", ids);
    file.integers("status", status);
    file.texts("kind", words);
    file.matrix("inputs", inputs);
    file.attribute("names",
                   std::vector<std::string>{"speed", "density", "temperature", "size"},
                   "inputs");
    file.matrix("outputs", outputs);
    file.attribute("names", std::vector<std::string>{"length", "ratio"}, "outputs");
    file.close();
}

inline nlohmann::json sample_config() {
    return nlohmann::json::parse(R"({
        "inputs": [{"name": "speed"}, {"name": "density", "transform": "log10"},
                   {"name": "temperature"}, {"name": "size"}],
        "category": "kind",
        "outputs": [{"name": "length", "divide_by": ["size"]}, {"name": "ratio"}],
        "hidden_layers": 7, "neurons": 0, "members": 2, "epochs": 400,
        "batch_sizes": [32, 16], "learning_rates": [0.01, 0.005],
        "validation_fraction": 0.2, "seed": 3})");
}

inline emulator::Dataset read_sample_database(const std::filesystem::path& path) {
    return emulator::read_dataset(path, {"speed", "density", "temperature", "size"},
                                  "kind", {"length", "ratio"});
}

}  // namespace taylorcal::testing
