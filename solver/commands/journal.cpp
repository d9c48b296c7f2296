#include "solver/commands/journal.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace taylorcal::commands {
namespace {

/// What is wrong with a first line that is not the wanted one, by the key that differs.
std::string difference(const nlohmann::json& found, const nlohmann::json& wanted) {
    for (const auto& [key, value] : wanted.items())
        if (!found.contains(key) || found.at(key) != value)
            return fmt::format("its {} is {}, this batch's is {}", key,
                               found.value(key, nlohmann::json()).dump(), value.dump());
    return "it has other keys";
}

}  // namespace

Journal::Journal(std::filesystem::path path, const nlohmann::json& header)
    : path_(std::move(path)) {
    std::string text;
    if (std::filesystem::exists(path_)) text = read_text(path_);
    const std::size_t last_newline = text.rfind('\n');
    text.resize(last_newline == std::string::npos ? 0 : last_newline + 1);
    if (!text.empty()) read_lines(text, header);

    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT, 0644);
    require(
        descriptor_ >= 0 &&
            ::ftruncate(descriptor_, static_cast<off_t>(text.size())) == 0 &&
            ::lseek(descriptor_, 0, SEEK_END) >= 0,
        fmt::format("{}: cannot be written ({}). Choose a folder that exists and that "
                    "you may write to.",
                    path_.string(), std::strerror(errno)));
    if (text.empty()) append_line(header.dump());
}

Journal::~Journal() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::read_lines(const std::string& text, const nlohmann::json& header) {
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        const std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        ++number;
        try {
            const auto parsed = nlohmann::json::parse(line);
            if (number > 1)
                found_.push_back(run_from_json(parsed));
            else
                require(parsed == header,
                        fmt::format("{}: begun by another batch ({}). Delete it to start "
                                    "anew, or go back to what it was begun with.",
                                    path_.string(), difference(parsed, header)));
        } catch (const nlohmann::json::exception&) {
            throw InputError(fmt::format(
                "{}, line {}: damaged. Delete the file to start the batch anew.",
                path_.string(), number));
        }
    }
}

void Journal::append(const FinishedRun& run) { append_line(to_json(run).dump()); }

void Journal::append_line(const std::string& line) {
    const std::string text = line + "\n";
    const auto written = ::write(descriptor_, text.data(), text.size());
    if (written != static_cast<ssize_t>(text.size()) || ::fsync(descriptor_) != 0)
        throw std::runtime_error(
            fmt::format("{}: cannot be written ({}). Is the disk full?", path_.string(),
                        std::strerror(errno)));
}

void Journal::remove() {
    ::close(descriptor_);
    descriptor_ = -1;
    std::filesystem::remove(path_);
}

}  // namespace taylorcal::commands
