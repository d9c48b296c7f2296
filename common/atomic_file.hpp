#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace taylorcal {

/// InputError unless a file can be written at `path`: in a folder that may be written to,
/// and in place of nothing but a regular file that is none of `inputs`. For the start of
/// a command, so that nothing is computed in vain.
void require_writable(const std::filesystem::path& path,
                      const std::vector<std::filesystem::path>& inputs = {});

/// Writes a file so that a reader sees all of it or nothing: `write` fills a temporary
/// name beside `path`, which is flushed to the disk and renamed. InputError unless
/// `require_writable`. The temporary file is removed when `write` throws.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text.
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

/// The last step alone, for a writer that keeps its temporary file open: flushes
/// `finished` to the disk and gives it its final name.
void rename_atomically(const std::filesystem::path& finished,
                       const std::filesystem::path& path);

/// The whole of a text file. InputError if it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace taylorcal
