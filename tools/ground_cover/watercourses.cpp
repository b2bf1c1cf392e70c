#include "tools/ground_cover/watercourses.h"

#include <string>
#include <utility>
#include <vector>

#include "tools/ground_cover/clip_segment.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/way_line.h"
#include "tools/ground_cover/widened_line.h"
#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// Below lakes and rivers with banks, whose middle lines these are, and over land.
constexpr int watercourse_rank = 590;
constexpr double least_width_m = 0.3, greatest_width_m = 2000;

bool is_said(const osm::OsmTags& tags, const char* key) {
  const std::string value = tag_of(tags, key);
  return !value.empty() && value != "no";
}

// Returns why a line is not drawn; empty where it is.
std::string find_reason_to_leave_out(const osm::OsmTags& tags) {
  if (tag_of(tags, "natural") == "coastline") return "coastline: the sea is not drawn";
  if (is_said(tags, "tunnel") || is_said(tags, "covered") ||
      tag_of(tags, "location") == "underground")
    return "watercourse below the ground";
  if (is_said(tags, "bridge")) return "watercourse on a bridge";
  if (is_said(tags, "intermittent") || is_said(tags, "seasonal"))
    return "watercourse that is dry at times";
  return {};
}

}  // namespace

void add_watercourses(std::span<const osm::OsmWay> lines, const place::LonLatToFrame& to_frame,
                      const Box& bounds, Cover& cover) {
  Widener widener;
  for (const osm::OsmWay& way : lines) {
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame, bounds);
    const double length_m = find_length_m(line, bounds);
    if (!(length_m > 0)) continue;
    const auto width =
        osm::find_length_m(way.tags, {"width", "est_width"}, least_width_m, greatest_width_m);
    std::string reason = find_reason_to_leave_out(way.tags);
    if (reason.empty() && !width) reason = "watercourse without a width";
    if (!reason.empty()) {
      cover.left_out_m[reason] += length_m;
      continue;
    }
    std::vector<Ring> rings = widener.widen(line, *width / 2);
    if (!rings.empty())
      cover.add({watercourse_rank, {GroundKind::water, false, false}, std::move(rings)});
  }
}

}  // namespace nightcity::ground_cover
