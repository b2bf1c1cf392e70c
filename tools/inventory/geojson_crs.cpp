#include "tools/inventory/geojson_crs.h"

#include <simdjson.h>

#include <algorithm>
#include <string_view>

#include "tools/cityjson/json.h"
#include "tools/cityjson/shared_parts.h"
#include "tools/inventory/server_limit.h"

namespace nightcity::inventory {
namespace {

// Objects and lists that a piece of JSON opens, less those that it closes.
struct Depth {
  int objects = 0, lists = 0;
  bool operator==(const Depth&) const = default;
};

// Calls back with the depth behind each character that stands in no text, until it returns true.
// Returns the place behind that character; npos where none is.
template <class Stop>
std::size_t walk_json(std::string_view text, const Stop& stop) {
  Depth depth;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') {
      ++i;
      continue;
    }
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '{' || c == '}') depth.objects += c == '{' ? 1 : -1;
    if (c == '[' || c == ']') depth.lists += c == '[' ? 1 : -1;
    if (stop(depth)) return i + 1;
  }
  return text.npos;
}

Depth measure_depth(std::string_view text) {
  Depth last;
  walk_json(text, [&](const Depth& depth) {
    last = depth;
    return false;
  });
  return last;
}

// Returns the text of the object or text that begins `rest`; "" where it ends before that does.
std::string_view cut_value(std::string_view rest) {
  const std::size_t end = walk_json(rest, [](const Depth& depth) { return depth == Depth{}; });
  return end == rest.npos ? std::string_view() : rest.substr(0, end);
}

}  // namespace

std::string find_odd_crs(const std::string& path) {
  constexpr std::string_view key = "\"crs\"";
  const std::string edges = read_edges(path);
  const std::string_view text = edges;
  simdjson::dom::parser parser;
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1)) {
    // A member of the whole; rows may have one of that name too.
    const bool is_of_whole = at < edge_bytes ? measure_depth(text.substr(0, at)) == Depth{1, 0}
                                             : measure_depth(text.substr(at)) == Depth{-1, 0};
    if (!is_of_whole) continue;
    const std::size_t begin = text.find_first_not_of(" \t\r\n:", at + key.size());
    if (begin == text.npos) break;
    if (text[begin] != '{' && text[begin] != '"') continue;
    simdjson::dom::element value;
    if (parser.parse(std::string(cut_value(text.substr(begin)))).get(value) != simdjson::SUCCESS)
      continue;
    simdjson::dom::object object;
    if (value.get(object) != simdjson::SUCCESS) return cityjson::to_text(value);
    if (cityjson::find_text(object, "type").ends_with("CRS"))
      return cityjson::find_crs_name(object);
  }
  return {};
}

}  // namespace nightcity::inventory
