// The names that files have while they are written: hidden ones beside an output, or none.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <utility>

namespace nightcity {

constexpr mode_t file_mode = 0666;  // less the user's mask, as any file

/// Returns the folder that a file lies in or is to lie in.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// Returns the folder for files that belong to no output: the one that TMPDIR names, or /tmp.
/// Throws Error where that is no folder that can be written into.
std::filesystem::path scratch_folder();

/// Calls `make(name)` with hidden names beside `path`, ".NAME.XXXXXX.part", until one is free.
/// Returns the name and what `make` returned, or an empty name and -1 with errno set.
std::pair<std::filesystem::path, int> make_hidden_beside(
    const std::filesystem::path& path,
    const std::function<int(const std::filesystem::path&)>& make);

/// Opens a new file under such a name. Returns the name and the descriptor.
std::pair<std::filesystem::path, int> open_hidden_beside(const std::filesystem::path& target);

/// Waits until the disk has the names in `folder`, where the file system can do that.
void sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace nightcity
