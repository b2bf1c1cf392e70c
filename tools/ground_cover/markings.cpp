// Paint on carriageways: bars of crossings and lines between lanes.
#include <algorithm>
#include <vector>

#include "tools/ground_cover/painter.h"
#include "tools/ground_cover/stop_lines.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/way_line.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {
namespace {

// StVO, sign 293 and RMS-1: bars of 0.50 m, as far apart, at least 3 m long (4 m as a rule).
constexpr double bar_m = 0.5;
// RMS-1: in towns a line between lanes is 0.12 m wide, 3 m long, with gaps of 6 m.
constexpr double line_width_m = 0.12, dash_m = 3, gap_m = 6;
// Lines end this far before a junction, so that they stay out of it: half a wide carriageway.
constexpr double junction_m = 10;

bool is_marked_crossing(const osm::OsmTags& tags) {
  if (tag_of(tags, "footway") != "crossing" && tag_of(tags, "path") != "crossing") return false;
  const std::string markings = tag_of(tags, "crossing:markings"), kind = tag_of(tags, "crossing");
  if (!markings.empty()) return markings == "zebra" || markings.starts_with("zebra:");
  return kind == "zebra" || kind == "marked" || kind == "uncontrolled" ||
         tag_of(tags, "crossing_ref") == "zebra";
}

// Roads of towns have lines between lanes from tertiary roads upwards, unless the map says no.
bool has_lane_lines(const roads::Carriageway& road, const osm::OsmTags& tags) {
  constexpr int lowest_rank = 4;
  return road.lanes[0] + road.lanes[1] > 1 && road.road_class->rank >= lowest_rank &&
         tag_of(tags, "lane_markings") != "no";
}

void add_lane_lines(const osm::OsmWay& way, const roads::Carriageway& road,
                    const std::vector<glm::dvec2>& line, const Junctions& junctions,
                    Painter& painter) {
  if (line.size() != way.lon_lat.size()) return;
  const MeasuredLine along(line);
  const int lanes = road.lanes[0] + road.lanes[1];
  const double edge_m = -lanes * road.lane_m() / 2;
  std::vector<double> junctions_m;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (junctions.holds(way.lon_lat[i])) junctions_m.push_back(along.at(i));
  for (double s = gap_m / 2; s + dash_m <= along.length_m() && !painter.is_done();
       s += dash_m + gap_m) {
    const auto next = std::lower_bound(junctions_m.begin(), junctions_m.end(), s - junction_m);
    const bool free = next == junctions_m.end() || *next > s + dash_m + junction_m;
    for (int lane = 1; free && lane < lanes; ++lane) {
      const double middle_m = edge_m + lane * road.lane_m();
      painter.add("dash between lanes", along.make_strip(s, s + dash_m, middle_m - line_width_m / 2,
                                                         middle_m + line_width_m / 2));
    }
  }
}

}  // namespace

void add_markings(std::span<const osm::OsmWay> ways, std::span<const osm::OsmPoint> controls,
                  bool on_the_left, const place::LonLatToFrame& to_frame, const Box& bounds,
                  Cover& cover) {
  Painter painter(bounds, cover);
  Junctions junctions;
  for (const osm::OsmWay& way : ways)
    if (is_drivable(roads::read_carriageway(way.tags))) junctions.add(way);
  const StopLines stop_lines(controls, junctions, on_the_left, painter);
  for (const osm::OsmWay& way : ways) {
    const auto road = roads::read_carriageway(way.tags);
    const bool crossing = is_marked_crossing(way.tags);
    const bool drivable = is_drivable(road);
    if (!crossing && !drivable) continue;
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame, bounds);
    if (line.size() < 2) continue;
    if (!crossing) {
      stop_lines.add(way, *road, line);
      if (has_lane_lines(*road, way.tags)) add_lane_lines(way, *road, line, junctions, painter);
      continue;
    }
    const MeasuredLine along(line);
    for (double s = 0; s + bar_m <= along.length_m() && !painter.is_done(); s += 2 * bar_m)
      painter.add("bar of a crossing",
                  along.make_strip(s, s + bar_m, -crossing_m / 2, crossing_m / 2));
  }
}

}  // namespace nightcity::ground_cover
