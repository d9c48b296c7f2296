#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace taylorcal {

/// Reads a JSON object strictly: every value is asked for by name and type, and a key
/// nobody knows is an error with the nearest known key as a hint. Messages name the
/// file, the path of the key ("solver.fidelity"), the value and what was expected.
class JsonReader {
  public:
    /// Parses a file. InputError with line and column if it is not JSON or not an object.
    static JsonReader from_file(const std::filesystem::path& path);
    /// Wraps a value already parsed; `where` is shown in messages.
    JsonReader(nlohmann::json value, std::string where, std::string key_path = "");

    bool has(std::string_view key) const;
    double number(std::string_view key) const;
    double number(std::string_view key, double default_value) const;
    /// A number within [lowest, highest], else InputError with the range.
    double number_in(std::string_view key, double lowest, double highest) const;
    double number_in(std::string_view key, double lowest, double highest,
                     double default_value) const;
    long long integer(std::string_view key) const;
    long long integer(std::string_view key, long long default_value) const;
    bool boolean(std::string_view key, bool default_value) const;
    std::string text(std::string_view key) const;
    std::string text(std::string_view key, const std::string& default_value) const;
    /// A text that must be one of `allowed`.
    std::string word(std::string_view key, const std::vector<std::string>& allowed) const;
    std::string word(std::string_view key, const std::vector<std::string>& allowed,
                     const std::string& default_value) const;
    std::vector<double> numbers(std::string_view key) const;
    std::vector<std::string> texts(std::string_view key) const;
    JsonReader object(std::string_view key) const;
    /// The member object, or an empty one when the key is absent.
    JsonReader object_or_empty(std::string_view key) const;
    std::vector<JsonReader> objects(std::string_view key) const;
    std::vector<std::string> keys() const;

    /// InputError if the object has a key that is not in `known`.
    void only(std::initializer_list<std::string_view> known) const;
    void only(const std::vector<std::string>& known) const;

    /// Throws InputError "<file>: <key path> <problem>" for a check of the caller's own.
    [[noreturn]] void fail(std::string_view key, const std::string& problem) const;

    const nlohmann::json& json() const { return value_; }
    const std::string& where() const { return where_; }

  private:
    const nlohmann::json& member(std::string_view key) const;
    [[noreturn]] void fail_type(std::string_view key, std::string_view expected) const;
    nlohmann::json value_;
    std::string where_;
    std::string key_path_;
};

}  // namespace taylorcal
