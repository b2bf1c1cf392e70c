// The tag `lit` of lamps and of ways.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/lights/night_schedule.h"
#include "tools/osm/osm_data.h"

namespace nightcity::lights {

struct LitTag {
  enum class Kind { unknown, lit, dark, not_understood };
  Kind kind = Kind::unknown;
  std::optional<NightSchedule> hours;  // lit: when, where the value says so
};

/// Reads a value of `lit` or `light:lit` (OSM wiki, Key:lit): "yes", "24/7", "automatic",
/// "limited", "interval", "20:00-06:00", "Mo-Su 18:00-23:00", "sunset-sunrise", "no",
/// "disused", "unknown". Lamps that are lit for a part of the night are dark from 23:00 to
/// 5:00 (half-night switching), and lamps that are lit at other times than our night are dark.
LitTag read_lit_tag(std::string_view text, Half half = Half::north);

/// Reads a value of `lit:conditional` (OSM wiki, Conditional restrictions) beside a lamp that is
/// lit all night or not at all: "no @ (23:00-05:00)" takes these hours from the night of a lit one,
/// "yes @ (sunset-23:00)" gives them to a dark one. Returns the hours of light, which are never()
/// where a dark one gets none in our night; empty where the text cannot be read, has several
/// conditions or says what `lit` says.
std::optional<NightSchedule> read_lit_condition(std::string_view text, bool is_lit,
                                                Half half = Half::north);

struct LitTags {
  LitTag lit;
  std::vector<std::string> unread;  // "lit=sometimes"
};

/// Reads the tag `key` ("lit", "light:lit") and the condition beside it ("lit:conditional").
/// Without the first, hours of light in a condition are all the light there is, and dark ones are
/// the gap. `half`: where the light stands, which decides the season (lit_hours.h).
LitTags read_lit_tags(const osm::OsmTags& tags, const std::string& key, Half half = Half::north);

}  // namespace nightcity::lights
