#include "tools/traffic/drivable.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/osm/tag_values.h"

namespace nightcity::traffic {
namespace {

constexpr double kmh = 1 / 3.6;
constexpr double mile_km = 1.609344;

std::string raw(const OsmWay& way, const char* key) {
  const auto found = way.tags.find(key);
  return found == way.tags.end() ? std::string() : found->second;
}

std::string tag(const OsmWay& way, const char* key) {
  return normalise_tag(raw(way, key));
}

bool one_of(std::string_view value, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), value) != names.end();
}

std::optional<int> whole(const std::string& text, int least, int greatest) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end == text.data() || value < least || value > greatest)
    return std::nullopt;
  return value;
}

/// The most special of the access tags decides.
bool closed(const OsmWay& way) {
  for (const char* key : {"motorcar", "motor_vehicle", "vehicle", "access"})
    if (const std::string value = tag(way, key); !value.empty())
      return one_of(value, {"no", "private", "agricultural", "forestry", "delivery", "emergency",
                            "military"});
  return false;
}

std::string reason_against(const OsmWay& way) {
  if (closed(way)) return "no access";
  if (tag(way, "area") == "yes") return "area";
  if (tag(way, "highway") == "service" && !one_of(tag(way, "service"), {"", "alley"}))
    return "driveway or aisle";
  if (one_of(tag(way, "tunnel"), {"building_passage"}) || one_of(tag(way, "covered"), {"yes"}) ||
      one_of(tag(way, "indoor"), {"yes"}))
    return "through a building";
  return {};
}

void read_directions(const OsmWay& way, Drivable& result) {
  const std::string oneway = tag(way, "oneway"), junction = tag(way, "junction");
  result.roundabout = one_of(junction, {"roundabout", "circular"});
  const std::string_view highway = result.road->highway;
  const bool implied = result.roundabout || highway == "motorway" || highway == "motorway_link";
  const bool against = one_of(oneway, {"_1", "reverse"});  // "-1", as normalise_tag leaves it
  const bool along =
      one_of(oneway, {"yes", "true", "1"}) || (implied && !one_of(oneway, {"no", "false", "0"}));
  if (against)
    result.lanes[0] = 0;
  else if (along)
    result.lanes[1] = 0;
}

void read_lanes(const OsmWay& way, Drivable& result) {
  const bool both = result.both_ways();
  const auto total = whole(raw(way, "lanes"), 1, 12);
  if (!both) {
    const int lanes = total.value_or(std::max(1, result.road->lanes / 2));
    for (int& count : result.lanes)
      if (count > 0) count = std::min(lanes, 6);
    return;
  }
  const int all = std::max(2, total.value_or(result.road->lanes));
  auto forward = whole(raw(way, "lanes:forward"), 1, 6),
       backward = whole(raw(way, "lanes:backward"), 1, 6);
  if (!forward && backward) forward = all - *backward;
  if (!backward && forward) backward = all - *forward;
  // An odd lane left over: nobody says whose, so nobody's (often it is for turning or for parking).
  result.lanes[0] = std::clamp(forward.value_or(all / 2), 1, 6);
  result.lanes[1] = std::clamp(backward.value_or(all / 2), 1, 6);
}

void read_width(const OsmWay& way, Drivable& result) {
  const int lanes = result.lanes[0] + result.lanes[1];
  // Less than 2.2 m a lane is a width of something else, or a street for one car: they pass each other
  // slowly.
  const double least = 2.2 * lanes;
  result.width_m = std::max(least, lanes * result.road->lane_m);
  if (const auto width = parse_length_m(raw(way, "width")); width && *width >= 2 && *width <= 60)
    result.width_m = std::clamp(*width, least, 4.5 * lanes);
}

void read_speed(const OsmWay& way, const Country& country, Drivable& result) {
  const double unsigned_limit = default_speed_kmh(*result.road, country);
  const auto both = parse_speed_kmh(raw(way, "maxspeed"));
  const char* const keys[] = {"maxspeed:forward", "maxspeed:backward"};
  for (std::size_t d = 0; d < 2; ++d) {
    auto limit = parse_speed_kmh(raw(way, keys[d]));
    if (!limit) limit = both;
    result.speed_m_s[d] = limit.value_or(unsigned_limit) * kmh;
  }
}

}  // namespace

std::optional<double> parse_speed_kmh(std::string_view text) {
  std::string value = normalise_tag(text.substr(0, text.find_first_of(";|")));
  std::optional<double> speed;
  const bool digits = !value.empty() && value[0] >= '0' && value[0] <= '9';
  if (digits) {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc()) return std::nullopt;
    const std::string unit = normalise_tag(std::string_view(end, value.data() + value.size()));
    if (unit.empty() || one_of(unit, {"km/h", "kmh", "kph", "_km/h", "_kmh", "_kph"}))
      speed = number;
    if (one_of(unit, {"mph", "_mph"})) speed = number * mile_km;
  } else if (value == "walk" || value.ends_with(":walk")) {
    speed = 7;
  } else if (value == "none") {
    speed = 130;  // the recommended speed where there is no limit
  } else if (value.ends_with("living_street")) {
    speed = 7;
  } else if (value.ends_with(":urban")) {
    speed = 50;
  } else if (value.ends_with(":rural")) {
    speed = 90;
  } else if (value.ends_with(":motorway")) {
    speed = 120;
  } else if (value == "gb:nsl_restricted") {
    speed = 30 * mile_km;
  } else if (value == "gb:nsl_single") {
    speed = 60 * mile_km;
  } else if (value == "gb:nsl_dual") {
    speed = 70 * mile_km;
  } else if (const auto zone = value.find("zone"); zone != std::string::npos) {
    std::string rest = value.substr(zone + 4);
    if (!rest.empty() && (rest.front() == ':' || rest.front() == '_')) rest.erase(0, 1);
    if (const auto number = whole(rest, 3, 150)) speed = *number;
  }
  if (!speed || !(*speed >= 3 && *speed <= 150)) return std::nullopt;
  return speed;
}

std::optional<Drivable> read_drivable(const OsmWay& way, const Country& country, std::string& why) {
  Drivable result;
  result.road = road_class(tag(way, "highway"));
  if (!result.road) {
    why = "not for motor vehicles";
    return std::nullopt;
  }
  why = reason_against(way);
  if (!why.empty()) return std::nullopt;
  read_directions(way, result);
  read_lanes(way, result);
  read_width(way, result);
  read_speed(way, country, result);
  result.structure =
      !one_of(tag(way, "bridge"), {"", "no"}) || !one_of(tag(way, "tunnel"), {"", "no"});
  const std::string layer = raw(way, "layer");
  if (const auto value = whole(layer, -5, 5)) result.layer = *value;
  return result;
}

}  // namespace nightcity::traffic
