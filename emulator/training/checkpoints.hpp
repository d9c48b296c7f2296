#pragma once

#include "emulator/training/train_member.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace taylorcal::emulator {

/// What a training that was killed goes on from: the state of each member in a file of
/// its own, `<stem>.<member>`, written every `interval_s` seconds.
class Checkpoints {
  public:
    /// None are kept.
    Checkpoints() = default;
    /// `key` is a digest of all that the training follows from: a file with another key
    /// is of another training and is not read.
    Checkpoints(std::filesystem::path stem, std::string key, double interval_s = 1);

    double interval_s() const { return interval_s_; }
    /// The state of a member; none when there is no file, it has another key, or is
    /// damaged.
    std::optional<MemberState> found(std::size_t member) const;
    /// Keeps a state. What cannot be written is only warned of: the training goes on.
    void keep(std::size_t member, const MemberState& state) const;
    /// Deletes the files of the members: the training is complete.
    void remove(std::size_t members) const;

  private:
    std::filesystem::path path(std::size_t member) const;
    std::filesystem::path stem_;  ///< empty: none are kept
    std::string key_;
    double interval_s_ = 1;
};

}  // namespace taylorcal::emulator
