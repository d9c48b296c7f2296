#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taylorcal::emulator {

struct TrainArguments {
    std::filesystem::path database;
    std::filesystem::path config;
    std::filesystem::path out;
    std::filesystem::path better;  ///< Runs of a better solver; empty for none.
    std::filesystem::path from;    ///< Emulator to go on from; empty for none.
    int threads = 1;
};

struct PredictArguments {
    std::filesystem::path emulator;
    std::filesystem::path table;   ///< Empty when the point is given by `set`.
    std::vector<std::string> set;  ///< "name=value"
    std::string category;
};

/// Trains on a database and writes the emulator; errors by output go to standard error.
int train(const TrainArguments& arguments);

/// Compares an emulator with a database; a comma-separated table on standard output.
int validate(const std::filesystem::path& emulator,
             const std::filesystem::path& database);

/// Predicts the points of a table, or one point; a comma-separated table on standard
/// output.
int predict(const PredictArguments& arguments);

}  // namespace taylorcal::emulator
