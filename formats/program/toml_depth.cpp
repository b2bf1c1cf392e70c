#include "formats/program/toml_depth.h"

#include <algorithm>

namespace nightcity::program {
namespace {

// Returns the place behind the string that begins at `begin`, or the text's end where it is never
// closed.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const bool is_multi_line =
      text.substr(begin, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
  std::size_t at = begin + (is_multi_line ? 3 : 1);
  while (at < text.size()) {
    if (quote == '"' && text[at] == '\\') {
      at += 2;
    } else if (!is_multi_line && text[at] == '\n') {
      return at;  // an error of TOML, which the parser reports
    } else if (text[at] != quote) {
      ++at;
    } else if (!is_multi_line) {
      return at + 1;
    } else if (text.substr(at, 3) == text.substr(begin, 3)) {
      return at + 3;
    } else {
      ++at;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> find_deep_key(std::string_view text, std::size_t max_parts) {
  constexpr std::string_view ends_key = "=,[]{}";
  std::size_t line = 1, parts = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, at);
      for (; at < end; ++at) line += text[at] == '\n';
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '\n') ++line;
    if (c == '\n' || ends_key.find(c) != std::string_view::npos) parts = 1;
    if (c == '.' && ++parts > max_parts) return line;
    ++at;
  }
  return {};
}

}  // namespace nightcity::program
