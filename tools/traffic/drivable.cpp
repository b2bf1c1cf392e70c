#include "tools/traffic/drivable.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/osm/lifecycle.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/today.h"

namespace nightcity::traffic {
namespace {

constexpr double kmh = 1 / 3.6;
constexpr double mile_km = 1.609344;

bool one_of(std::string_view value, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), value) != names.end();
}

std::optional<int> whole(const std::string& text, int min, int max) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end == text.data() || value < min || value > max) return std::nullopt;
  return value;
}

/// Returns whether the public may not drive here: the most specific of the access tags decides.
bool is_closed(const osm::OsmWay& way) {
  for (const char* key : {"motorcar", "motor_vehicle", "vehicle", "access"})
    if (const std::string value = osm::find_tag(way.tags, key); !value.empty())
      return one_of(value, {"no", "private", "agricultural", "forestry", "delivery", "emergency",
                            "military"});
  return false;
}

std::string reason_against(const osm::OsmWay& way) {
  if (is_closed(way)) return "no access";
  if (osm::is_out_of_use(way.tags, today())) return "disused";
  if (osm::says_area(way.tags)) return "area";
  if (osm::find_tag(way.tags, "highway") == "service" &&
      !one_of(osm::find_tag(way.tags, "service"), {"", "alley"}))
    return "driveway or aisle";
  if (one_of(osm::find_tag(way.tags, "tunnel"), {"building_passage"}) ||
      one_of(osm::find_tag(way.tags, "covered"), {"yes"}) ||
      one_of(osm::find_tag(way.tags, "indoor"), {"yes"}))
    return "through a building";
  return {};
}

void read_speed(const osm::OsmWay& way, const Country& country, Drivable& result) {
  const double unsigned_limit = default_speed_kmh(*result.carriageway.road_class, country);
  const auto both = parse_speed_kmh(osm::find_raw_tag(way.tags, "maxspeed"));
  const char* const keys[] = {"maxspeed:forward", "maxspeed:backward"};
  for (std::size_t d = 0; d < 2; ++d) {
    auto limit = parse_speed_kmh(osm::find_raw_tag(way.tags, keys[d]));
    if (!limit) limit = both;
    result.speed_m_s[d] = limit.value_or(unsigned_limit) * kmh;
  }
}

}  // namespace

std::optional<double> parse_speed_kmh(std::string_view text) {
  std::string value = osm::normalise_tag(text.substr(0, text.find_first_of(";|")));
  std::optional<double> speed;
  const bool digits = !value.empty() && value[0] >= '0' && value[0] <= '9';
  if (digits) {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc()) return std::nullopt;
    const std::string unit = osm::normalise_tag(std::string_view(end, value.data() + value.size()));
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

std::optional<Drivable> read_drivable(const osm::OsmWay& way, const Country& country,
                                      std::string& why) {
  Drivable result;
  result.traffic = find_traffic_class(osm::find_tag(way.tags, "highway"));
  const auto carriageway = roads::read_carriageway(way.tags);
  if (!result.traffic || !carriageway) {
    why = "not for motor vehicles";
    return std::nullopt;
  }
  why = reason_against(way);
  if (!why.empty()) return std::nullopt;
  result.carriageway = *carriageway;
  read_speed(way, country, result);
  result.bridge = osm::is_tagged(way.tags, "bridge");
  result.structure = result.bridge || osm::is_tagged(way.tags, "tunnel");
  const std::string layer = osm::find_raw_tag(way.tags, "layer");
  if (const auto value = whole(layer, -5, 5)) result.layer = *value;
  return result;
}

}  // namespace nightcity::traffic
