#include "tools/ground_cover/watercourses.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
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

struct WidthRow {
  std::string_view waterway;
  double m;
};
// The widths of OSM2World (WaterModule.WATERWAY_WIDTHS), which draws lines as we do. Rivers that
// are much wider are areas on most maps, over which their lines are not seen. That of a tidal
// channel is an assumption: as a river.
constexpr std::array usual_widths{WidthRow{"river", 3},    WidthRow{"canal", 2},
                                  WidthRow{"drain", 1},    WidthRow{"ditch", 1},
                                  WidthRow{"stream", 0.5}, WidthRow{"tidal_channel", 3}};

constexpr double least_width_m = 0.3, greatest_width_m = 2000;

// Returns why a line is not drawn; empty where it is.
std::string find_reason_to_leave_out(const osm::OsmTags& tags) {
  if (osm::is_tagged(tags, "tunnel") || osm::is_tagged(tags, "covered") ||
      osm::find_tag(tags, "location") == "underground")
    return "watercourse below the ground";
  if (osm::is_tagged(tags, "bridge")) return "watercourse on a bridge";
  if (osm::is_tagged(tags, "intermittent") || osm::is_tagged(tags, "seasonal"))
    return "watercourse that is dry at times";
  return {};
}

std::optional<double> find_usual_width(const osm::OsmTags& tags) {
  const std::string kind = osm::find_tag(tags, "waterway");
  for (const WidthRow& row : usual_widths)
    if (row.waterway == kind) return row.m;
  return std::nullopt;
}

}  // namespace

void add_watercourses(std::span<const osm::OsmWay> lines, const place::LonLatToFrame& to_frame,
                      const Box& bounds, Cover& cover) {
  Widener widener;
  for (const osm::OsmWay& way : lines) {
    if (osm::find_tag(way.tags, "natural") == "coastline") continue;  // of the sea (sea.h)
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame, bounds);
    const double length_m = find_length_m(line, bounds);
    if (!(length_m > 0)) continue;
    auto width =
        osm::find_length_m(way.tags, {"width", "est_width"}, least_width_m, greatest_width_m);
    std::string reason = find_reason_to_leave_out(way.tags);
    if (reason.empty() && !width && (width = find_usual_width(way.tags)))
      ++cover.assumed["width of a watercourse"];
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
