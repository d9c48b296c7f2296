#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace taylorcal {

/// Reports long work on standard error with an estimate of the remaining time: a bar that
/// redraws itself on a terminal, a line every ten seconds in a log. Thread safe.
class Progress {
  public:
    Progress(std::string what, std::uint64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// `done` more units are finished; `note` is shown after the figures.
    void advance(std::uint64_t done = 1, const std::string& note = "");

  private:
    void show(bool last);
    std::mutex mutex_;
    std::string what_;
    std::string note_;
    std::uint64_t total_;
    std::uint64_t done_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
};

}  // namespace taylorcal
