#pragma once

#include <cstdint>
#include <string>

namespace taylorcal {

/// Most threads that a program starts.
inline constexpr std::uint64_t most_threads = 1024;

/// What is wrong with the text of an option, empty if nothing is: for CLI11's check().
/// CLI11 alone takes an empty name for none, and -1 for the largest unsigned number.
std::string empty_problem(const std::string& text);
/// Unless it is a whole number from 0 to `most`; `note` follows the range.
std::string count_problem(const std::string& text, std::uint64_t most,
                          const std::string& note = "");
/// Unless it is a number of threads, where 0 stands for one a processor.
std::string threads_problem(const std::string& text);

}  // namespace taylorcal
