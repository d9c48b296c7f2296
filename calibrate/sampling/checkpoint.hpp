#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

using NamedNumbers = std::map<std::string, std::vector<double>>;

/// Where a sampling saves how far it has come.
struct Checkpoint {
    std::filesystem::path path;  ///< empty: nowhere
    std::string key;             ///< digest of everything that the draws depend on
    double seconds = 1;          ///< between two saves

    /// That of a part of the work, beside this one.
    Checkpoint of_part(const std::string& name) const;
};

/// Saves numbers. What cannot be written is only warned of: the sampling goes on.
void save(const Checkpoint& checkpoint, const NamedNumbers& numbers);

/// What was saved; nothing when there is no file, it has another key, or is damaged.
std::optional<NamedNumbers> saved(const Checkpoint& checkpoint);

/// Deletes the file and those of the parts: the sampling is complete.
void remove(const Checkpoint& checkpoint);

}  // namespace taylorcal::calibrate
