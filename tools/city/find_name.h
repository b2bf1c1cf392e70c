// Finds names in the text of a city model.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace nightcity::city {

/// Returns text.find(name, from), for a name that is not empty. It looks for the first capital of
/// the name: most of the text is coordinates and small letters, so that capitals are rare, and
/// memchr passes over the rest several times as fast as a search for all letters does.
inline std::size_t find_name(std::string_view text, std::string_view name, std::size_t from = 0) {
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto capital = std::find_if(name.begin(), name.end(), is_capital);
  const auto before = static_cast<std::size_t>(capital == name.end() ? 0 : capital - name.begin());
  const std::size_t behind = name.size() - before;
  for (std::size_t at = from + before; at + behind <= text.size(); ++at) {
    const void* const found =
        std::memchr(text.data() + at, name[before], text.size() - behind + 1 - at);
    if (!found) break;
    at = static_cast<std::size_t>(static_cast<const char*>(found) - text.data());
    if (text[at - before] == name[0] && text.substr(at - before, name.size()) == name)
      return at - before;
  }
  return std::string_view::npos;
}

}  // namespace nightcity::city
