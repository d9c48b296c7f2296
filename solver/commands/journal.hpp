#pragma once

#include "solver/commands/finished_run.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace taylorcal::commands {

/// The runs that a batch has finished so far, one JSON line each, flushed to the disk:
/// a killed batch goes on from it. The first line says what the batch computes.
class Journal {
  public:
    /// Opens `path` or begins it. A line torn by a kill at the end is dropped. InputError
    /// with the remedy when the journal was begun with another `header`, is damaged, or
    /// is another process's at this moment.
    Journal(std::filesystem::path path, const nlohmann::json& header);
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// The runs found at opening.
    const std::vector<FinishedRun>& found() const { return found_; }
    /// Adds a line and returns when it is on the disk; a line that does not fit leaves
    /// the file as it was.
    void append(const FinishedRun& run);
    /// Closes and deletes the file: its batch is complete.
    void remove();

  private:
    /// An open file of the system, closed with its owner.
    struct Descriptor {
        Descriptor() = default;
        ~Descriptor() { close(); }
        Descriptor(const Descriptor&) = delete;
        Descriptor& operator=(const Descriptor&) = delete;
        void close();
        int number = -1;
    };
    void open();
    void append_line(const std::string& line);
    /// A line after the first. InputError that names it when it is not a whole run.
    FinishedRun run_of(const nlohmann::json& parsed, int number) const;
    void read_lines(const std::string& text, const nlohmann::json& header);
    std::filesystem::path path_;
    std::vector<FinishedRun> found_;
    Descriptor file_;
    std::int64_t size_ = 0;  ///< of the whole lines in bytes
};

}  // namespace taylorcal::commands
