#include "tools/obj/unit_comment.h"

#include <algorithm>
#include <string_view>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

namespace nightcity::obj {
namespace {

// Returns what stands behind "unit" or "units" and a colon or an equals sign; "" where nothing
// does.
std::string_view find_unit(std::string_view comment) {
  std::size_t at = comment.find("unit");
  if (at == comment.npos) return {};
  at += 4;
  if (comment.substr(at).starts_with('s')) ++at;
  comment = city::trim(comment.substr(at));
  if (!comment.starts_with(':') && !comment.starts_with('=')) return {};
  comment = city::trim(comment.substr(1));
  return comment.substr(0, comment.find_first_of(" \t,;()"));
}

}  // namespace

std::string find_unit_comment(const city::Document& document) {
  constexpr std::size_t beginning = 4096;
  const std::string lower = to_lower(city::read_start(document, beginning));
  for (std::string_view rest = lower; !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    const std::string_view line = city::trim(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.starts_with('#')) continue;
    if (const std::string_view unit = find_unit(line); !unit.empty()) return std::string(unit);
  }
  return {};
}

}  // namespace nightcity::obj
