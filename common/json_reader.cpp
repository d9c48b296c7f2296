#include "common/json_reader.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal {

namespace {

using Json = nlohmann::json;

std::string join_path(const std::string& parent, std::string_view key) {
    return parent.empty() ? std::string(key) : fmt::format("{}.{}", parent, key);
}

/// "3 column 14" of a byte offset; both count from 1.
std::string line_and_column(const std::string& text, std::size_t byte) {
    const std::size_t offset = byte == 0 ? 0 : std::min(byte - 1, text.size());
    const auto begin = text.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(offset);
    const auto line = 1 + std::count(begin, end, '\n');
    const std::size_t newline =
        offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
    const std::size_t column =
        newline == std::string::npos ? offset + 1 : offset - newline;
    return fmt::format("line {}, column {}", line, column);
}

/// The parser's words after its own prefix, which repeats the place.
std::string reason(const Json::exception& error) {
    const std::string message = error.what();
    const std::size_t start = message.find(": ");
    return start == std::string::npos ? message : message.substr(start + 2);
}

/// A callback that refuses a key given twice in one object (JSON would keep the last).
Json::parser_callback_t refuse_duplicate_keys(const std::string& file) {
    return [file, seen = std::vector<std::set<std::string>>()](
               int, Json::parse_event_t event, Json& parsed) mutable {
        if (event == Json::parse_event_t::object_start) seen.emplace_back();
        if (event == Json::parse_event_t::object_end) seen.pop_back();
        if (event == Json::parse_event_t::key) {
            const auto key = parsed.get<std::string>();
            require(seen.back().insert(key).second,
                    fmt::format("{}: key \"{}\" is given twice. Keep one of them.", file,
                                key));
        }
        return true;
    };
}

}  // namespace

JsonReader JsonReader::from_file(const std::filesystem::path& path) {
    const std::string text = read_text(path);
    Json parsed;
    try {
        parsed = Json::parse(text, refuse_duplicate_keys(path.string()));
    } catch (const Json::parse_error& error) {
        throw InputError(fmt::format("{}, {}: not valid JSON ({}). Correct it there.",
                                     path.string(), line_and_column(text, error.byte),
                                     reason(error)));
    } catch (const Json::exception& error) {
        throw InputError(
            fmt::format("{}: not valid JSON ({}).", path.string(), error.what()));
    }
    return {std::move(parsed), path.string()};
}

JsonReader::JsonReader(Json value, std::string where, std::string key_path)
    : value_(std::move(value)), where_(std::move(where)), key_path_(std::move(key_path)) {
    if (!value_.is_object()) {
        throw InputError(fmt::format(
            "{}: {} is {} (expected an object). Write {{\"key\": value, ...}}.", where_,
            key_path_.empty() ? "the whole" : key_path_, value_.type_name()));
    }
}

bool JsonReader::has(std::string_view key) const { return value_.contains(key); }

const Json& JsonReader::member(std::string_view key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) fail(key, "is missing. Add it.");
    return *found;
}

void JsonReader::fail_type(std::string_view key, std::string_view expected) const {
    fail(key, fmt::format("= {} (expected {}).", member(key).dump(), expected));
}

void JsonReader::fail(std::string_view key, const std::string& problem) const {
    throw InputError(
        fmt::format("{}: {} {}", where_, join_path(key_path_, key), problem));
}

double JsonReader::number(std::string_view key) const {
    if (!member(key).is_number()) fail_type(key, "a number, without quotes");
    return member(key).get<double>();
}

double JsonReader::number(std::string_view key, double default_value) const {
    return has(key) ? number(key) : default_value;
}

double JsonReader::number_in(std::string_view key, double lowest, double highest) const {
    const double value = number(key);
    if (!(value >= lowest && value <= highest)) {
        fail(key, fmt::format("= {} (expected {} to {}). Choose a value in this range.",
                              value, lowest, highest));
    }
    return value;
}

double JsonReader::number_in(std::string_view key, double lowest, double highest,
                             double default_value) const {
    return has(key) ? number_in(key, lowest, highest) : default_value;
}

long long JsonReader::integer(std::string_view key) const {
    const Json& value = member(key);
    if (value.is_number_integer()) return value.get<long long>();
    // 1e6 is how many a tool writes a large whole number.
    constexpr double largest_exact = 0x1p53;
    const double real = value.is_number() ? value.get<double>() : 0.5;
    if (real != std::floor(real) || std::abs(real) > largest_exact) {
        fail_type(key, "a whole number, without quotes");
    }
    return static_cast<long long>(real);
}

long long JsonReader::integer(std::string_view key, long long default_value) const {
    return has(key) ? integer(key) : default_value;
}

bool JsonReader::boolean(std::string_view key, bool default_value) const {
    if (!has(key)) return default_value;
    if (!member(key).is_boolean()) fail_type(key, "true or false, without quotes");
    return member(key).get<bool>();
}

std::string JsonReader::text(std::string_view key) const {
    if (!member(key).is_string()) fail_type(key, "a text in quotes");
    return member(key).get<std::string>();
}

std::string JsonReader::text(std::string_view key,
                             const std::string& default_value) const {
    return has(key) ? text(key) : default_value;
}

std::string JsonReader::word(std::string_view key,
                             const std::vector<std::string>& allowed) const {
    std::string value = text(key);
    if (std::ranges::find(allowed, value) == allowed.end()) {
        fail(key, fmt::format("= \"{}\" (expected one of: {}).{}", value,
                              fmt::join(allowed, ", "),
                              nearest_hint(value, allowed, " Is \"", "\" meant?")));
    }
    return value;
}

std::string JsonReader::word(std::string_view key,
                             const std::vector<std::string>& allowed,
                             const std::string& default_value) const {
    return has(key) ? word(key, allowed) : default_value;
}

std::vector<double> JsonReader::numbers(std::string_view key) const {
    const Json& list = member(key);
    const auto is_number = [](const Json& item) { return item.is_number(); };
    if (!list.is_array() || !std::ranges::all_of(list, is_number)) {
        fail_type(key, "a list of numbers");
    }
    return list.get<std::vector<double>>();
}

std::vector<std::string> JsonReader::texts(std::string_view key) const {
    const Json& list = member(key);
    const auto is_text = [](const Json& item) { return item.is_string(); };
    if (!list.is_array() || !std::ranges::all_of(list, is_text)) {
        fail_type(key, "a list of texts");
    }
    return list.get<std::vector<std::string>>();
}

JsonReader JsonReader::object(std::string_view key) const {
    return {member(key), where_, join_path(key_path_, key)};
}

JsonReader JsonReader::object_or_empty(std::string_view key) const {
    return has(key) ? object(key)
                    : JsonReader(Json::object(), where_, join_path(key_path_, key));
}

std::vector<JsonReader> JsonReader::objects(std::string_view key) const {
    const Json& list = member(key);
    if (!list.is_array()) fail_type(key, "a list of objects");
    std::vector<JsonReader> readers;
    for (std::size_t i = 0; i < list.size(); ++i) {
        readers.emplace_back(list[i], where_,
                             fmt::format("{}[{}]", join_path(key_path_, key), i));
    }
    return readers;
}

std::vector<std::string> JsonReader::keys() const {
    std::vector<std::string> names;
    for (const auto& item : value_.items()) names.push_back(item.key());
    return names;
}

void JsonReader::only(std::initializer_list<std::string_view> known) const {
    only(std::vector<std::string>(known.begin(), known.end()));
}

void JsonReader::only(const std::vector<std::string>& known) const {
    for (const std::string& key : keys()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        fail(key, fmt::format("is not a known key.{} Known here: {}.",
                              nearest_hint(key, known, " Is \"", "\" meant?"),
                              fmt::join(known, ", ")));
    }
}

}  // namespace taylorcal
