// The sums of a RAR archive's files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::city {

/// The CRC-32 of each entry's bytes, in their order; none where an entry has none.
using EntrySums = std::vector<std::optional<std::uint32_t>>;

/// Returns what the headers of a RAR archive (version 4 or 5) say, for each file, folder and link
/// in their order, of the sum of its bytes. libarchive 3.6 reads past the place where it would
/// compare them, so that a damaged archive gave wrong bytes without a word. The list ends where the
/// archive does, or is broken.
EntrySums list_rar_sums(const std::string& path);

/// Returns whether the first bytes are of a RAR archive in several volumes.
bool is_rar_volume(std::string_view start);

}  // namespace nightcity::city
