#include "common/atomic_file.hpp"

#include "common/errors.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

namespace taylorcal {

namespace {

namespace fs = std::filesystem;

/// Keeps a second process from writing to the same temporary name; the system lets go of
/// it when this process ends, however it ends. A file system without locks goes without.
class Lock {
  public:
    Lock(const fs::path& temporary, const fs::path& path)
        : descriptor_(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)) {
        const bool busy = descriptor_ >= 0 &&
                          ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 &&
                          errno == EWOULDBLOCK;
        if (busy) ::close(descriptor_);
        require(!busy, fmt::format("{}: another process is writing it. Wait for it to "
                                   "end, then start again.",
                                   path.string()));
    }
    ~Lock() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

  private:
    int descriptor_;
};

/// Asks the system to put a file (or a folder's list of names) on the disk.
void flush_to_disk(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY);
    if (descriptor < 0) return;  // Nothing to flush; the rename below reports it.
    ::fsync(descriptor);
    ::close(descriptor);
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// What stands in the way at the place of a file to write; empty if nothing does.
std::string obstacle(const fs::path& path) {
    std::error_code unknown;
    const fs::file_status status = fs::status(path, unknown);
    if (!fs::exists(status) || fs::is_regular_file(status)) return "";
    return fs::is_directory(status) ? "a folder" : "a device, pipe or socket";
}

}  // namespace

void require_writable(const fs::path& path, const std::vector<fs::path>& inputs) {
    require(!path.empty(),
            "the name of the file to write is empty (expected a path). Give one.");
    const std::string in_the_way = obstacle(path);
    require(in_the_way.empty(),
            fmt::format("{}: cannot be written (it is {}; expected a new name or a "
                        "regular file). Give another name.",
                        path.string(), in_the_way));
    std::error_code absent;
    for (const fs::path& input : inputs)
        require(!fs::equivalent(path, input, absent),
                fmt::format("{}: is an input of this command, which its output would "
                            "replace. Give the output another name.",
                            path.string()));
    const fs::path folder = folder_of(path);
    require(fs::is_directory(folder),
            fmt::format("{}: cannot be written (no folder {}). Make the folder or give "
                        "another name.",
                        path.string(), folder.string()));
    require(
        ::access(folder.c_str(), W_OK) == 0,
        fmt::format("{}: cannot be written ({}). Choose a folder that you may write to.",
                    path.string(), std::strerror(errno)));
}

void write_atomically(const fs::path& path,
                      const std::function<void(const fs::path&)>& write) {
    require_writable(path);
    fs::path temporary = path;
    temporary += ".tmp";
    const Lock lock(temporary, path);
    std::error_code ignored;
    try {
        write(temporary);
        rename_atomically(temporary, path);
    } catch (...) {
        fs::remove(temporary, ignored);
        throw;
    }
}

void rename_atomically(const fs::path& finished, const fs::path& path) {
    flush_to_disk(finished);
    std::error_code problem;
    fs::rename(finished, path, problem);
    require(!problem,
            fmt::format("{}: cannot be written ({}).", path.string(), problem.message()));
    flush_to_disk(folder_of(path));
}

void write_text_atomically(const fs::path& path, const std::string& text) {
    write_atomically(path, [&](const fs::path& temporary) {
        std::ofstream file(temporary, std::ios::binary);
        file << text << std::flush;
        require(file.good(), fmt::format("{}: cannot be written ({}).", path.string(),
                                         std::strerror(errno)));
    });
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    require(
        file.good() && !fs::is_directory(path),
        fmt::format("{}: cannot be read ({}). Check the name, or make the file first.",
                    path.string(),
                    fs::is_directory(path) ? "it is a folder" : std::strerror(errno)));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace taylorcal
