#include "common/option_text.hpp"

#include <charconv>
#include <system_error>

#include <fmt/core.h>

namespace taylorcal {

std::string empty_problem(const std::string& text) {
    return text.empty() ? "is empty (expected a text). Fill it in, or leave it out." : "";
}

std::string count_problem(const std::string& text, std::uint64_t most,
                          const std::string& note) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, problem] = std::from_chars(text.data(), end, value);
    if (problem == std::errc{} && stopped == end && value <= most) return "";
    return fmt::format("{} (expected a whole number from 0 to {}{}).", text, most, note);
}

std::string threads_problem(const std::string& text) {
    return count_problem(text, most_threads, ", where 0 is one a processor");
}

}  // namespace taylorcal
