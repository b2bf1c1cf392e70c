#include "tools/inventory/server_limit.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
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

constexpr const char* remedy = ": ask it for the others, and name each file";

}  // namespace

std::string read_edges(const std::string& path) {
  constexpr vsi_l_offset edge = edge_bytes;
  VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
  if (!file) return {};
  VSIFSeekL(file, 0, SEEK_END);
  const vsi_l_offset size = VSIFTellL(file);
  std::string text(std::min(size, 2 * edge), '\0');
  const std::size_t first = std::min(size, edge);
  VSIRewindL(file);
  std::size_t got = VSIFReadL(text.data(), 1, first, file);
  if (size > edge) {
    VSIFSeekL(file, size - (text.size() - first), SEEK_SET);
    got += VSIFReadL(text.data() + first, 1, text.size() - first, file);
  }
  VSIFCloseL(file);
  return got == text.size() ? text : std::string();
}

std::string say_part_of_rows(std::string_view key) {
  return "the server sent a part of its rows (" + std::string(key) + ")" + remedy;
}

std::string say_some_of_rows(std::size_t sent, std::size_t all, std::string_view key) {
  return "the server sent " + std::to_string(sent) + " of its " + std::to_string(all) + " rows (" +
         std::string(key) + ")" + remedy;
}

std::string say_one_page() {
  return std::string("the server sent one page of its rows (a link to the next)") + remedy;
}

std::string find_server_limit(const std::string& path, std::size_t rows) {
  const std::string text = read_edges(path);
  const std::size_t begin = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
  if (begin == std::string::npos || text[begin] != '{') return {};
  if (find_value(text, "\"exceededTransferLimit\"").starts_with("true"))
    return say_part_of_rows("exceededTransferLimit");
  for (const std::string_view key : {"numberMatched", "totalFeatures"}) {
    const auto matched = find_count(text, "\"" + std::string(key) + "\"");
    const std::size_t returned = find_count(text, "\"numberReturned\"").value_or(rows);
    if (matched && *matched > returned) return say_some_of_rows(returned, *matched, key);
  }
  // OGC API: "links": [{"rel": "next", ...}].
  for (std::string_view rest = text; !(rest = find_value(rest, "\"rel\"")).empty();)
    if (rest.starts_with("\"next\"")) return say_one_page();
  return {};
}

}  // namespace nightcity::inventory
