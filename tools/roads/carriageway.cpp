#include "tools/roads/carriageway.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string>
#include <string_view>

#include "tools/osm/tag_values.h"
#include "tools/roads/parking_lane.h"

namespace nightcity::roads {
namespace {

constexpr double max_width_m = 60;
constexpr int max_lanes = 12, max_lanes_each_way = 6;

bool one_of(std::string_view value, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), value) != names.end();
}

std::optional<int> count_at(const osm::OsmTags& tags, const std::string& key, int max) {
  const std::string text = osm::find_raw_tag(tags, key);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end == text.data() || value < 1 || value > max) return std::nullopt;
  return value;
}

std::size_t count_parts(const std::string& text) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '|'));
}

/// Returns the number of lanes from KEY SUFFIX or, without it, from the turns that are painted on
/// each ("left|through|right").
std::optional<int> find_lanes(const osm::OsmTags& tags, const char* suffix, int max) {
  const std::string end(suffix);
  if (const auto said = count_at(tags, "lanes" + end, max)) return said;
  const std::string turns = osm::find_raw_tag(tags, "turn:lanes" + end);
  const std::size_t count = count_parts(turns);
  if (turns.empty() || count > static_cast<std::size_t>(max)) return std::nullopt;
  return static_cast<int>(count);
}

/// Returns the sum of the widths of lanes, such as "3|3.5|3".
std::optional<double> sum_widths(const std::string& text) {
  if (text.empty() || count_parts(text) > static_cast<std::size_t>(max_lanes)) return std::nullopt;
  double sum_m = 0;
  for (std::string_view rest = text;; rest.remove_prefix(rest.find('|') + 1)) {
    const auto width = osm::parse_length_m(rest.substr(0, rest.find('|')));
    if (!width || *width <= 0) return std::nullopt;
    sum_m += *width;
    if (rest.find('|') == std::string_view::npos) return sum_m;
  }
}

/// Returns the width from the first of the tags that say one; OSM wiki, "Key:width": `est_width`
/// is an estimate, and `width:carriageway` goes from kerb to kerb. Most streets of Japan have the
/// range of Yahoo's map (`yh:WIDTH`, "3.0m～5.5m").
std::optional<double> find_width_m(const osm::OsmTags& tags, double min_m) {
  const auto is_sound = [&](const std::optional<double>& m) {
    return m && *m >= min_m && *m <= max_width_m;
  };
  for (const char* key : {"width:carriageway", "width", "est_width", "yh:WIDTH"})
    if (const auto width = osm::parse_length_m(osm::find_raw_tag(tags, key)); is_sound(width))
      return width;
  if (const auto all = sum_widths(osm::find_raw_tag(tags, "width:lanes")); is_sound(all))
    return all;
  const auto forward = sum_widths(osm::find_raw_tag(tags, "width:lanes:forward")),
             backward = sum_widths(osm::find_raw_tag(tags, "width:lanes:backward"));
  if (forward && backward && is_sound(*forward + *backward)) return *forward + *backward;
  return std::nullopt;
}

/// The directions that are driven: along the way and against it.
struct Directions {
  bool along = true, against = true;
};

Directions read_directions(const osm::OsmTags& tags, const Carriageway& carriageway) {
  const std::string oneway = osm::find_tag(tags, "oneway");
  if (one_of(oneway, {"_1", "reverse"})) return {false, true};  // "-1", as normalise_tag leaves it
  const bool implied = carriageway.roundabout || carriageway.road_class->one_way;
  if (one_of(oneway, {"yes", "true", "1"}) || (implied && !one_of(oneway, {"no", "false", "0"})))
    return {true, false};
  return {true, true};
}

/// Fills in the lanes of each direction and returns how many lanes the carriageway has.
int read_lanes(const osm::OsmTags& tags, Carriageway& carriageway) {
  const RoadClass& road = *carriageway.road_class;
  auto total = count_at(tags, "lanes", max_lanes);
  const Directions driven = read_directions(tags, carriageway);
  if (!driven.along || !driven.against) {
    if (!total) total = find_lanes(tags, driven.along ? ":forward" : ":backward", max_lanes);
    if (!total) total = find_lanes(tags, "", max_lanes);
    const int lanes = total.value_or(std::max(1, road.lanes / 2));
    carriageway.lanes[driven.along ? 0 : 1] = std::min(lanes, max_lanes_each_way);
    return lanes;
  }
  const int lanes = total.value_or(road.lanes);
  const int both = std::max(2, lanes);
  auto forward = find_lanes(tags, ":forward", max_lanes_each_way),
       backward = find_lanes(tags, ":backward", max_lanes_each_way);
  // A lane for both directions, mostly to turn left from.
  const int shared = count_at(tags, "lanes:both_ways", max_lanes_each_way).value_or(0);
  if (!forward && backward) forward = both - shared - *backward;
  if (!backward && forward) backward = both - shared - *forward;
  // Nobody drives on an odd lane whose direction is not tagged: often it is for turning or parking.
  carriageway.lanes[0] = std::clamp(forward.value_or(both / 2), 1, max_lanes_each_way);
  carriageway.lanes[1] = std::clamp(backward.value_or(both / 2), 1, max_lanes_each_way);
  return forward ? std::max(lanes, carriageway.lanes[0] + carriageway.lanes[1] + shared) : lanes;
}

void read_parking(const osm::OsmTags& tags, Carriageway& carriageway) {
  constexpr const char* sides[] = {"left", "right"};
  for (std::size_t side = 0; side < 2; ++side)
    if (const auto lane = read_parking_lane(tags, sides[side]))
      carriageway.parked_m[side] = lane->within_edge_m();
}

/// Leaves the lanes that are driven on their least width.
void limit_parking(Carriageway& carriageway) {
  double(&parked_m)[2] = carriageway.parked_m;
  const double wanted_m = parked_m[0] + parked_m[1],
               room_m =
                   carriageway.width_m - min_lane_m * (carriageway.lanes[0] + carriageway.lanes[1]);
  if (wanted_m <= room_m) return;
  for (double& side_m : parked_m) side_m *= room_m / wanted_m;
}

}  // namespace

double Carriageway::lane_m() const {
  const int driven = lanes[0] + lanes[1];
  if (driven == 0) return 0;
  const double free_m = width_m - parked_m[0] - parked_m[1];
  return std::clamp((free_m - road_class->shoulder_m) / driven, min_lane_m, max_lane_m);
}

std::optional<Carriageway> read_carriageway(const osm::OsmTags& tags) {
  Carriageway carriageway;
  carriageway.road_class = find_road_class(osm::find_tag(tags, "highway"));
  if (!carriageway.road_class || osm::find_tag(tags, "footway") == "crossing") return std::nullopt;
  const RoadClass& road = *carriageway.road_class;
  carriageway.roundabout = one_of(osm::find_tag(tags, "junction"), {"roundabout", "circular"});
  const bool path = road.tier == RoadTier::path;
  const int lanes = path ? 1 : read_lanes(tags, carriageway);
  carriageway.width_m = lanes == 1 ? road.single_lane_m : lanes * road.lane_m + road.shoulder_m;
  if (!path) read_parking(tags, carriageway);
  carriageway.width_m += carriageway.parked_m[0] + carriageway.parked_m[1];
  const double min_width_m = path ? 1 : 2;  // less is a slip of the pen
  if (const auto width = find_width_m(tags, min_width_m))
    carriageway.width_m = *width;
  else
    carriageway.is_widened = carriageway.parked_m[0] + carriageway.parked_m[1] > 0;
  // A street tagged narrower than its lanes is a street for one car, whose drivers pass each other
  // slowly.
  carriageway.width_m =
      std::max(carriageway.width_m, min_lane_m * (carriageway.lanes[0] + carriageway.lanes[1]));
  limit_parking(carriageway);
  return carriageway;
}

double carriageway_width(const osm::OsmTags& tags) {
  const auto carriageway = read_carriageway(tags);
  return carriageway ? carriageway->width_m : 0;
}

}  // namespace nightcity::roads
