#include "common/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include <fmt/core.h>
#include <unistd.h>

namespace taylorcal {

namespace {

using Seconds = std::chrono::duration<double>;

std::string duration_text(double seconds) {
    const auto whole = std::lround(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      shown_(start_) {}

Progress::~Progress() {
    const std::lock_guard lock(mutex_);
    show(true);
}

void Progress::advance(std::uint64_t done, const std::string& note) {
    const std::lock_guard lock(mutex_);
    done_ += done;
    if (!note.empty()) note_ = note;
    const double pause = terminal_ ? 0.2 : 10;  // [s]
    const auto now = std::chrono::steady_clock::now();
    if (Seconds(now - shown_).count() < pause) return;
    shown_ = now;
    show(false);
}

void Progress::show(bool last) {
    const double elapsed = Seconds(std::chrono::steady_clock::now() - start_).count();
    const double share =
        total_ == 0 ? 1 : static_cast<double>(done_) / static_cast<double>(total_);
    std::string time = fmt::format("{} elapsed", duration_text(elapsed));
    if (!last && share > 0) {
        time += fmt::format(", {} left", duration_text(elapsed * (1 / share - 1)));
    }
    std::string line =
        fmt::format("{} {}/{} ({:.0f} %), {}", what_, done_, total_, 100 * share, time);
    if (!note_.empty()) line += ", " + note_;
    if (!terminal_) {
        std::cerr << line + '\n';
        return;
    }
    constexpr int width = 20;
    const auto filled = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * width);
    const std::string bar = std::string(filled, '=') + std::string(width - filled, ' ');
    // Return to the line's start and clear what a longer line may have left behind.
    std::cerr << fmt::format("\r\x1b[K[{}] {}{}", bar, line, last ? "\n" : "")
              << std::flush;
}

}  // namespace taylorcal
