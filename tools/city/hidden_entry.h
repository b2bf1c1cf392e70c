// Entries of archives that nobody put there.
#pragma once

#include <string_view>

namespace nightcity::city {

/// Returns whether an entry is hidden, or was added by a program. Archives made on a Mac hold
/// "__MACOSX/._name" or "._name" for each file, with icons and the like in it; programs that do not
/// know the pax format unpack its headers into "PaxHeaders.123/name".
inline bool is_hidden_entry(std::string_view entry) {
  const std::size_t slash = entry.rfind('/');
  const std::string_view name = slash == entry.npos ? entry : entry.substr(slash + 1);
  return name.starts_with('.') || entry.starts_with("__MACOSX/") ||
         entry.starts_with("PaxHeader") || entry.find("/PaxHeader") != entry.npos;
}

}  // namespace nightcity::city
