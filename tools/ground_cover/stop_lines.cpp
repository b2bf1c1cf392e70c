#include "tools/ground_cover/stop_lines.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "formats/finite.h"
#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// StVO, sign 294 and RMS-1: a stop line is 0.50 m wide, 1.00 m before a crossing.
constexpr double stop_line_m = 0.5, before_crossing_m = 1;
// StVO, sign 341 and RMS-1: a line at which to give way has dashes of 0.50 m with gaps of 0.25 m.
constexpr double block_m = 0.5, block_gap_m = 0.25;
// A sign without a direction is for the junction that is as near as this: an assumption.
constexpr double near_m = 60;

}  // namespace

StopLines::StopLines(std::span<const osm::OsmPoint> controls, const Junctions& junctions,
                     bool on_the_left, Painter& painter)
    : junctions_(junctions), on_the_left_(on_the_left), painter_(painter) {
  for (const osm::OsmPoint& control : controls)
    if (finite(control.lon_lat))
      controls_.try_emplace({control.lon_lat.x, control.lon_lat.y}, &control);
}

void StopLines::add(const osm::OsmWay& way, const roads::Carriageway& road,
                    const std::vector<glm::dvec2>& line) const {
  if (controls_.empty() || line.size() != way.lon_lat.size()) return;
  const MeasuredLine along(line);
  std::vector<double> junctions_m;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (junctions_.holds(way.lon_lat[i])) junctions_m.push_back(along.at(i));
  for (std::size_t i = 0; i < line.size() && !painter_.is_done(); ++i) {
    const auto found = controls_.find({way.lon_lat[i].x, way.lon_lat[i].y});
    if (found == controls_.end()) continue;
    const osm::OsmTags& tags = found->second->tags;
    const Directions directions =
        find_directions(road, junctions_m, way.lon_lat[i], along.at(i), tags);
    // Vehicles of each direction come to a node between two ways along one of them.
    if (directions[0] && i > 0) paint(road, along, along.at(i), false, tags);
    if (directions[1] && i + 1 < line.size()) paint(road, along, along.at(i), true, tags);
  }
}

StopLines::Directions StopLines::find_directions(const roads::Carriageway& road,
                                                 const std::vector<double>& junctions_m,
                                                 const glm::dvec2& node, double at_m,
                                                 const osm::OsmTags& tags) const {
  const Directions driven{road.lanes[0] > 0, road.lanes[1] > 0};
  std::string said = osm::find_tag(tags, "traffic_signals:direction");
  if (said.empty()) said = osm::find_tag(tags, "direction");
  if (said == "forward") return {driven[0], false};
  if (said == "backward") return {false, driven[1]};
  if (said == "both") return driven;
  if (junctions_.holds(node)) {
    painter_.leave_out("stop line of a sign in the middle of a junction");
    return {false, false};
  }
  if (driven[0] != driven[1]) return driven;
  const auto next = std::upper_bound(junctions_m.begin(), junctions_m.end(), at_m);
  const double ahead_m = next == junctions_m.end() ? near_m : std::min(near_m, *next - at_m),
               behind_m = next == junctions_m.begin() ? near_m : std::min(near_m, at_m - next[-1]);
  if (ahead_m != behind_m) return {ahead_m < behind_m, behind_m < ahead_m};
  if (osm::find_tag(tags, "highway") == "traffic_signals") return driven;
  painter_.leave_out("stop line whose direction nothing says");
  return {false, false};
}

void StopLines::paint(const roads::Carriageway& road, const MeasuredLine& along, double at_m,
                      bool against, const osm::OsmTags& tags) const {
  const bool crossing = tags.contains("crossing") && osm::find_tag(tags, "crossing") != "no";
  const double back_m = crossing ? crossing_m / 2 + before_crossing_m : 0;
  const double from_m = against ? at_m + back_m : at_m - back_m - stop_line_m;
  const double whole_m = (road.lanes[0] + road.lanes[1]) * road.lane_m(),
               width_m = road.lanes[against ? 1 : 0] * road.lane_m();
  // Lanes along the way lie to its right where vehicles keep to the right.
  const bool on_right = on_the_left_ == against;
  const double right_m = road.lanes_left_m() + (on_right ? -whole_m / 2 : whole_m / 2 - width_m);
  if (osm::find_tag(tags, "highway") != "give_way")
    return painter_.add("stop line",
                        along.make_strip(from_m, from_m + stop_line_m, right_m, right_m + width_m));
  for (double s = block_gap_m / 2; s + block_m <= width_m; s += block_m + block_gap_m)
    painter_.add("dash at which to give way", along.make_strip(from_m, from_m + stop_line_m,
                                                               right_m + s, right_m + s + block_m));
}

}  // namespace nightcity::ground_cover
