#include "tools/terrain/text_rasters.h"

#include <array>
#include <utility>

#include "formats/to_lower.h"
#include "tools/city/text_encoding.h"

namespace nightcity::terrain {
namespace {

constexpr std::string_view mark_of_utf8 = "\xef\xbb\xbf";

}  // namespace

bool is_named_as_text_raster(std::string_view name) {
  constexpr std::array<std::string_view, 6> endings{".asc", ".xyz", ".txt", ".csv", ".dat", ".grd"};
  return city::ends_with_any(to_lower(name), endings);
}

bool is_odd_text(std::string_view start) {
  return start.starts_with(mark_of_utf8) || start.starts_with('#') || city::begins_as_utf16(start);
}

std::unique_ptr<city::ByteSource> straighten_text(std::unique_ptr<city::ByteSource> source) {
  constexpr std::size_t most_comments = 65536;
  source = city::to_utf8(std::move(source));
  std::string start = city::read_next(*source, most_comments);
  if (start.starts_with(mark_of_utf8)) start.erase(0, mark_of_utf8.size());
  while (start.starts_with('#')) {
    const std::size_t end = start.find_first_of("\r\n");
    if (end == std::string::npos) break;
    start.erase(0, start.find_first_not_of("\r\n", end));
  }
  return city::resume(std::move(start), std::move(source));
}

}  // namespace nightcity::terrain
