// Counts the lines of a text.
#pragma once

#include <cstddef>
#include <cstring>
#include <string_view>

namespace nightcity::city {

/// Returns the number of line ends in a text. Lines are long in city models: this is several times
/// as fast as std::count.
inline std::size_t count_line_ends(std::string_view text) {
  std::size_t count = 0;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at < end; ++at, ++count) {
    at = static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at)));
    if (!at) break;
  }
  return count;
}

}  // namespace nightcity::city
