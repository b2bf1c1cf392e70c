// The tags of street lamps in OSM, read with the units, typos and lists that people write.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/lights/lamp_defaults.h"
#include "tools/lights/night_schedule.h"
#include "tools/osm/osm_data.h"

namespace nightcity::lights {

enum class LampMount { straight_mast, bent_mast, wall, suspended, bollard };

struct LampTags {
  bool unlit = false;       // the lamp gives no light
  std::string_view outage;  // why, in words: "lit=no", "broken", ...; empty if it does
  bool mast = false;        // tower:type=lighting, floodlight
  std::optional<double> height_m, flux_lm, power_w, cct_k, tilt_degrees;
  std::optional<double> ele_m;      // of the ground
  std::optional<glm::vec3> colour;  // linear Rec. 709, luminance 1
  std::optional<LampType> type;
  std::optional<LampMount> mount;
  std::string model;                       // of the luminaire, as an inventory names it
  std::optional<NightSchedule> hours;      // when it is lit, where a tag says so
  std::vector<double> directions_degrees;  // clockwise from north
  // Luminaires on the post, 1 to 12, and no fewer than directions.
  int count = 1;
  // Values that were not understood ("height=tall"), and their number.
  std::map<std::string, std::size_t> unread;
};

/// Reads all tags of a lamp. Never throws: values that are not understood are counted in `unread`.
LampTags read_lamp_tags(const osm::OsmTags& tags, Half half = Half::north);

/// Returns a colour temperature in kelvin, 1000 to 20000: "3000", "3000 K", "3000k", "warm_white",
/// the middle of "3000-4000", the first of a list.
std::optional<double> parse_cct_k(std::string_view text);
/// Returns the type of the first word of a list that names one.
std::optional<LampType> parse_lamp_type(std::string_view text);

}  // namespace nightcity::lights
