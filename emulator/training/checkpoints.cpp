#include "emulator/training/checkpoints.hpp"

#include "common/hdf5_file.hpp"
#include "common/sha256.hpp"

#include <exception>

#include <fmt/core.h>
#include <spdlog/spdlog.h>

namespace taylorcal::emulator {

namespace {

constexpr const char* checkpoint_schema = "taylorcal/checkpoint/1";
using Parameters = Network<float>::Vector;

std::vector<double> exact(const Parameters& values) {
    return {values.begin(), values.end()};
}

Parameters read_parameters(const Hdf5Reader& file, const std::string& name) {
    const std::vector<double> values = file.numbers(name);
    Parameters result(static_cast<Eigen::Index>(values.size()));
    for (Eigen::Index i = 0; i < result.size(); ++i)
        result[i] = static_cast<float>(values[static_cast<std::size_t>(i)]);
    return result;
}

std::string bytes_of(const Parameters& values) {
    return {reinterpret_cast<const char*>(values.data()),
            static_cast<std::size_t>(values.size()) * sizeof(float)};
}

/// Tells a file that was damaged where HDF5 does not see it.
std::string digest_of(const MemberState& state) {
    return sha256(
        fmt::format("{} {} {:a} ", state.epochs, state.adam.steps, state.lowest) +
        bytes_of(state.parameters) + bytes_of(state.best) + bytes_of(state.adam.mean) +
        bytes_of(state.adam.square));
}

MemberState read_state(const Hdf5Reader& file) {
    MemberState state;
    const auto counts = file.integers("epochs_and_steps");
    if (counts.size() != 2) throw std::runtime_error("it is damaged");
    state.epochs = static_cast<int>(counts[0]);
    state.adam.steps = static_cast<long>(counts[1]);
    state.lowest = file.number_attribute("lowest");
    state.parameters = read_parameters(file, "parameters");
    state.best = read_parameters(file, "best");
    state.adam.mean = read_parameters(file, "mean");
    state.adam.square = read_parameters(file, "square");
    if (file.text_attribute("state_digest") != digest_of(state))
        throw std::runtime_error("it is damaged");
    return state;
}

void write_state(const std::filesystem::path& path, const std::string& key,
                 const MemberState& state) {
    Hdf5Writer file(path);
    file.attribute("schema", checkpoint_schema);
    file.attribute("key", key);
    file.attribute("state_digest", digest_of(state));
    file.integers("epochs_and_steps", {state.epochs, state.adam.steps});
    file.attribute("lowest", state.lowest);
    file.numbers("parameters", exact(state.parameters));
    file.numbers("best", exact(state.best));
    file.numbers("mean", exact(state.adam.mean));
    file.numbers("square", exact(state.adam.square));
    file.close();
}

}  // namespace

Checkpoints::Checkpoints(std::filesystem::path stem, std::string key, double interval_s)
    : stem_(std::move(stem)), key_(std::move(key)), interval_s_(interval_s) {}

std::filesystem::path Checkpoints::path(std::size_t member) const {
    return fmt::format("{}.{}", stem_.string(), member);
}

// The HDF5 library serves one thread at a time.
std::optional<MemberState> Checkpoints::found(std::size_t member) const {
    std::optional<MemberState> state;
    if (stem_.empty() || !std::filesystem::exists(path(member))) return state;
#pragma omp critical(taylorcal_checkpoints)
    try {
        const Hdf5Reader file(path(member));
        file.expect_schema(checkpoint_schema);
        if (file.text_attribute("key") == key_)
            state = read_state(file);
        else
            spdlog::info("{} is of another training and is not used",
                         path(member).string());
    } catch (const std::exception& error) {
        spdlog::warn("{} is not used: {}", path(member).string(), error.what());
    }
    return state;
}

void Checkpoints::keep(std::size_t member, const MemberState& state) const {
    if (stem_.empty()) return;
#pragma omp critical(taylorcal_checkpoints)
    try {
        write_state(path(member), key_, state);
    } catch (const std::exception& error) {
        spdlog::warn("no checkpoint, the training goes on without: {}", error.what());
    }
}

void Checkpoints::remove(std::size_t members) const {
    std::error_code ignored;
    for (std::size_t member = 0; !stem_.empty() && member < members; ++member)
        std::filesystem::remove(path(member), ignored);
}

}  // namespace taylorcal::emulator
