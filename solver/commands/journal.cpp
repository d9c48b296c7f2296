#include "solver/commands/journal.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
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

/// Whether `path` still leads to the open file: a batch that ends deletes its journal.
bool is_there(const std::filesystem::path& path, int descriptor) {
    struct stat open {
    }, named{};
    return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
           open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

/// Opens the file for this process alone; the system lets go of it when the process ends,
/// however it ends. A file system without locks goes without.
void Journal::open() {
    do {
        file_.close();
        file_.number = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
        require(file_.number >= 0,
                fmt::format("{}: cannot be written ({}). Choose a folder that exists and "
                            "that you may write to.",
                            path_.string(), std::strerror(errno)));
        require(::flock(file_.number, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK,
                fmt::format("{}: another batch with this output is running. Wait for it "
                            "or stop it, then start again: finished runs are kept.",
                            path_.string()));
    } while (!is_there(path_, file_.number));
}

Journal::Journal(std::filesystem::path path, const nlohmann::json& header)
    : path_(std::move(path)) {
    open();
    std::string text = read_text(path_);
    const std::size_t last_newline = text.rfind('\n');
    text.resize(last_newline == std::string::npos ? 0 : last_newline + 1);
    if (!text.empty()) read_lines(text, header);

    size_ = static_cast<std::int64_t>(text.size());
    require(
        ::ftruncate(file_.number, size_) == 0 && ::lseek(file_.number, 0, SEEK_END) >= 0,
        fmt::format("{}: cannot be written ({}).", path_.string(), std::strerror(errno)));
    if (text.empty()) append_line(header.dump());
}

void Journal::Descriptor::close() {
    if (number >= 0) ::close(number);
    number = -1;
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
                found_.push_back(run_of(parsed, number));
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

FinishedRun Journal::run_of(const nlohmann::json& parsed, int number) const {
    try {
        return run_from_json(parsed);
    } catch (const InputError& error) {
        throw InputError(fmt::format(
            "{}, line {}: damaged ({}). Delete the file to start the batch anew.",
            path_.string(), number, error.what()));
    }
}

void Journal::append(const FinishedRun& run) { append_line(to_json(run).dump()); }

void Journal::append_line(const std::string& line) {
    const std::string text = line + "\n";
    const auto written = ::write(file_.number, text.data(), text.size());
    if (written == static_cast<ssize_t>(text.size()) && ::fsync(file_.number) == 0) {
        size_ += written;
        return;
    }
    const std::string problem =
        written < 0 || written == static_cast<ssize_t>(text.size())
            ? std::strerror(errno)
            : "no space for the whole line";
    // Half a line amid others would make the journal unreadable; at the end it is
    // dropped.
    if (::ftruncate(file_.number, size_) == 0) ::lseek(file_.number, size_, SEEK_SET);
    throw std::runtime_error(
        fmt::format("{}: cannot be written ({}). Make space and start again: finished "
                    "runs are kept.",
                    path_.string(), problem));
}

void Journal::remove() {
    std::filesystem::remove(path_);  // before another process may take it over
    file_.close();
}

}  // namespace taylorcal::commands
