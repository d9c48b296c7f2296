#include "calibrate/sampling/checkpoint.hpp"

#include "common/hdf5_file.hpp"
#include "common/sha256.hpp"

#include <exception>
#include <stdexcept>

#include <spdlog/spdlog.h>

namespace taylorcal::calibrate {
namespace {

constexpr const char* checkpoint_schema = "taylorcal/sampling/1";

/// Tells a file that was damaged where HDF5 does not see it.
std::string digest_of(const NamedNumbers& numbers) {
    std::string bytes;
    for (const auto& [name, values] : numbers) {
        bytes += name + '\n';
        bytes.append(reinterpret_cast<const char*>(values.data()),
                     values.size() * sizeof(double));
    }
    return sha256(bytes);
}

}  // namespace

Checkpoint Checkpoint::of_part(const std::string& name) const {
    Checkpoint part = *this;
    if (!path.empty()) part.path += "." + name;
    return part;
}

void save(const Checkpoint& checkpoint, const NamedNumbers& numbers) {
    if (checkpoint.path.empty()) return;
    try {
        Hdf5Writer file(checkpoint.path);
        file.attribute("schema", checkpoint_schema);
        file.attribute("key", checkpoint.key);
        file.attribute("state_digest", digest_of(numbers));
        std::vector<std::string> names;
        for (const auto& [name, values] : numbers) {
            file.numbers(name, values);
            names.push_back(name);
        }
        file.attribute("names", names);
        file.close();
    } catch (const std::exception& error) {
        spdlog::warn("no checkpoint, the sampling goes on without: {}", error.what());
    }
}

std::optional<NamedNumbers> saved(const Checkpoint& checkpoint) {
    if (checkpoint.path.empty() || !std::filesystem::exists(checkpoint.path))
        return std::nullopt;
    try {
        const Hdf5Reader file(checkpoint.path);
        file.expect_schema(checkpoint_schema);
        if (file.text_attribute("key") != checkpoint.key) {
            spdlog::info("{} is of another sampling and is not used",
                         checkpoint.path.string());
            return std::nullopt;
        }
        NamedNumbers numbers;
        for (const std::string& name : file.texts_attribute("names"))
            numbers[name] = file.numbers(name);
        if (file.text_attribute("state_digest") != digest_of(numbers))
            throw std::runtime_error("it is damaged");
        return numbers;
    } catch (const std::exception& error) {
        spdlog::warn("{} is not used: {}", checkpoint.path.string(), error.what());
        return std::nullopt;
    }
}

void remove(const Checkpoint& checkpoint) {
    namespace fs = std::filesystem;
    if (checkpoint.path.empty()) return;
    const fs::path folder =
        checkpoint.path.has_parent_path() ? checkpoint.path.parent_path() : fs::path(".");
    const std::string own = checkpoint.path.filename().string();
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name == own || name.starts_with(own + ".")) files.push_back(entry.path());
    }
    std::error_code ignored;
    for (const fs::path& file : files) fs::remove(file, ignored);
}

}  // namespace taylorcal::calibrate
