#include "tools/inventory/server_limit.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

namespace nightcity::inventory {
namespace {

// Returns the text behind a key and its colon; "" without the key.
std::string_view find_value(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + key.size());
  const std::size_t value = text.find_first_not_of(" \t\r\n:");
  return value == std::string_view::npos ? std::string_view() : text.substr(value);
}

std::optional<std::uint64_t> find_count(std::string_view text, std::string_view key) {
  const std::string_view value = find_value(text, key);
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), count);
  return error == std::errc() ? std::optional(count) : std::nullopt;
}

// Returns the beginning and the end of a file, where servers write what they say about the whole.
std::string read_edges(const std::filesystem::path& file) {
  constexpr std::uintmax_t edge = std::uintmax_t{1} << 16;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) return {};
  std::string text(std::min(size, 2 * edge), '\0');
  const auto first = static_cast<std::streamsize>(std::min(size, edge));
  stream.read(text.data(), first);
  if (size > edge) {
    const auto rest = static_cast<std::streamsize>(text.size()) - first;
    stream.seekg(-rest, std::ios::end);
    stream.read(text.data() + first, rest);
  }
  return text;
}

}  // namespace

std::string find_server_limit(const std::filesystem::path& file) {
  constexpr const char* remedy = ": ask it for the others, and name each file";
  const std::string text = read_edges(file);
  const std::size_t begin = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
  if (begin == std::string::npos || text[begin] != '{') return {};
  if (find_value(text, "\"exceededTransferLimit\"").starts_with("true"))
    return std::string("the server sent a part of its rows (exceededTransferLimit)") + remedy;
  const auto matched = find_count(text, "\"numberMatched\""),
             returned = find_count(text, "\"numberReturned\"");
  if (matched && returned && *matched > *returned)
    return "the server sent " + std::to_string(*returned) + " of its " + std::to_string(*matched) +
           " rows (numberMatched)" + remedy;
  // OGC API: "links": [{"rel": "next", ...}].
  for (std::string_view rest = text; !(rest = find_value(rest, "\"rel\"")).empty();)
    if (rest.starts_with("\"next\""))
      return std::string("the server sent one page of its rows (a link to the next)") + remedy;
  return {};
}

}  // namespace nightcity::inventory
