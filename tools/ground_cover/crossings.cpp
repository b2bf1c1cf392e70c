#include "tools/ground_cover/crossings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "formats/finite.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// StVO, sign 293 and RMS-1: bars of 0.50 m, as far apart, at least 3 m long (4 m as a rule).
constexpr double bar_m = 0.5;

// Returns whether the tags of a crossing say that it has bars.
bool says_bars(const osm::OsmTags& tags) {
  const std::string markings = osm::find_tag(tags, "crossing:markings"),
                    kind = osm::find_tag(tags, "crossing");
  // OSM wiki, "Key:crossing:markings": a ladder is bars between two lines, and "yes" says that
  // there are markings, whose kind `crossing` may say.
  if (!markings.empty() && markings != "yes") {
    const auto parts = osm::split_list(markings);
    return std::any_of(parts.begin(), parts.end(), [](std::string_view part) {
      const std::string_view shape = part.substr(0, part.find(':'));
      return shape == "zebra" || shape == "ladder";
    });
  }
  return kind == "zebra" || kind == "marked" || kind == "uncontrolled" ||
         osm::find_tag(tags, "crossing_ref") == "zebra";
}

// Returns whether the tags of a crossing say what is painted there, or that nothing is.
bool says_paint(const osm::OsmTags& tags) {
  return tags.contains("crossing") || tags.contains("crossing:markings") ||
         tags.contains("crossing_ref");
}

}  // namespace

bool is_crossing_way(const osm::OsmTags& tags) {
  return osm::find_tag(tags, "footway") == "crossing" ||
         osm::find_tag(tags, "path") == "crossing" || osm::find_tag(tags, "cycleway") == "crossing";
}

bool is_marked_crossing(const osm::OsmTags& tags) {
  const bool on_foot =
      osm::find_tag(tags, "footway") == "crossing" || osm::find_tag(tags, "path") == "crossing";
  return on_foot && says_bars(tags);
}

void add_bars(const std::vector<glm::dvec2>& line, Painter& painter) {
  const MeasuredLine along(line);
  for (double s = 0; s + bar_m <= along.length_m() && !painter.is_done(); s += 2 * bar_m)
    painter.add("bar of a crossing",
                along.make_strip(s, s + bar_m, -crossing_m / 2, crossing_m / 2));
}

CrossingNodes::CrossingNodes(std::span<const osm::OsmPoint> nodes,
                             std::span<const osm::OsmWay> ways, const Junctions& junctions,
                             Painter& painter)
    : junctions_(junctions), painter_(painter) {
  for (const osm::OsmPoint& node : nodes)
    if (finite(node.lon_lat) && says_bars(node.tags))
      places_.emplace(node.lon_lat.x, node.lon_lat.y);
  for (const osm::OsmWay& way : ways)
    if (is_crossing_way(way.tags) && says_paint(way.tags))
      for (const glm::dvec2& p : way.lon_lat)
        if (finite(p)) places_.erase({p.x, p.y});
}

void CrossingNodes::add(const osm::OsmWay& way, const roads::Carriageway& road,
                        const std::vector<glm::dvec2>& line) {
  if (places_.empty() || line.size() != way.lon_lat.size()) return;
  const MeasuredLine along(line);
  for (std::size_t i = 0; i < line.size() && !painter_.is_done(); ++i) {
    const glm::dvec2& node = way.lon_lat[i];
    if (!finite(node) || places_.erase({node.x, node.y}) == 0) continue;
    if (junctions_.holds(node)) {
      painter_.leave_out("crossing in the middle of a junction");
      continue;
    }
    const double from_m = along.at(i) - crossing_m / 2;
    // As many bars as fit, in the middle of the carriageway.
    const double bars = std::floor((road.width_m + bar_m) / (2 * bar_m));
    const double right_m = -(2 * bars - 1) * bar_m / 2;
    for (double bar = 0; bar < bars && !painter_.is_done(); ++bar) {
      const double at_m = right_m + 2 * bar_m * bar;
      painter_.add("bar of a crossing",
                   along.make_strip(from_m, from_m + crossing_m, at_m, at_m + bar_m));
    }
  }
}

}  // namespace nightcity::ground_cover
