// Files that are read as a whole because they are small by their nature: cameras, settings, edits.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace nightcity {

/// The size beyond which such a file is refused, so that a wrong name, or a file without end, costs
/// neither time nor memory.
constexpr std::size_t max_small_file_bytes = std::size_t{64} << 20;

/// Returns the bytes of a file. Throws Error where it is missing, a folder, no regular file, cannot
/// be read or has more than `max_bytes`.
std::string read_small_file(const std::filesystem::path& path,
                            std::size_t max_bytes = max_small_file_bytes);

}  // namespace nightcity
