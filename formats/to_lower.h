// Lower case for keywords of file formats, names of units and endings.
#pragma once

#include <string>
#include <string_view>

namespace nightcity {

/// Returns `text` with A to Z in lower case, whatever the locale.
inline std::string to_lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace nightcity
