// Paint on carriageways, and the lines between lanes.
#include <algorithm>
#include <vector>

#include "tools/ground_cover/bay_lines.h"
#include "tools/ground_cover/crossings.h"
#include "tools/ground_cover/junctions.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/painter.h"
#include "tools/ground_cover/stop_lines.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/way_line.h"
#include "tools/osm/tag_values.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {
namespace {

// RMS-1: in towns a line between lanes is 0.12 m wide, 3 m long, with gaps of 6 m.
constexpr double line_width_m = 0.12, dash_m = 3, gap_m = 6;
// Lines end this far before a junction, so that they stay out of it: half a wide carriageway.
constexpr double junction_m = 10;

// Roads of towns have lines between lanes from tertiary roads upwards, unless the map says no.
bool has_lane_lines(const roads::Carriageway& road, const osm::OsmTags& tags) {
  constexpr int lowest_rank = 4;
  return road.lanes[0] + road.lanes[1] > 1 && road.road_class->rank >= lowest_rank &&
         osm::find_tag(tags, "lane_markings") != "no";
}

void add_lane_lines(const osm::OsmWay& way, const roads::Carriageway& road,
                    const std::vector<glm::dvec2>& line, const Junctions& junctions,
                    Painter& painter) {
  if (line.size() != way.lon_lat.size()) return;
  const MeasuredLine along(line);
  const int lanes = road.lanes[0] + road.lanes[1];
  const double edge_m = road.lanes_left_m() - lanes * road.lane_m() / 2;
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

void add_markings(const StreetPaint& paint, const place::LonLatToFrame& to_frame, const Box& bounds,
                  Cover& cover) {
  Painter painter(bounds, cover);
  const Junctions junctions(paint.ways);
  const StopLines stop_lines(paint.controls, junctions, paint.on_the_left, painter);
  CrossingNodes crossings(paint.crossings, paint.ways, junctions, painter);
  for (const osm::OsmWay& way : paint.ways) {
    const auto road = roads::read_carriageway(way.tags);
    const bool crossing = is_marked_crossing(way.tags);
    if (!crossing && !is_drivable(road)) continue;
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame, bounds);
    if (line.size() < 2) continue;
    if (crossing) {
      add_bars(line, painter);
      continue;
    }
    stop_lines.add(way, *road, line);
    crossings.add(way, *road, line);
    if (has_lane_lines(*road, way.tags)) add_lane_lines(way, *road, line, junctions, painter);
    if (paint.bays) add_bay_lines(way, *road, line, junctions, paint.on_the_left, painter);
  }
}

}  // namespace nightcity::ground_cover
