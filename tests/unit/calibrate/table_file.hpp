#pragma once

#include "common/atomic_file.hpp"

#include <filesystem>
#include <string>

#include <unistd.h>

namespace taylorcal::calibrate::toys {

/// A file of this test process that is removed at the end of the scope.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& text = "")
        : path_(std::filesystem::temp_directory_path() /
                (std::to_string(::getpid()) + "_" + name)) {
        if (!text.empty()) write_text_atomically(path_, text);
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace taylorcal::calibrate::toys
