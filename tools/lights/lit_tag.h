// The tag `lit` of lamps and of ways.
#pragma once

#include <optional>
#include <string_view>

#include "tools/lights/night_schedule.h"

namespace nightcity::lights {

struct LitTag {
  enum class Kind { unknown, lit, dark, not_understood };
  Kind kind = Kind::unknown;
  std::optional<NightSchedule> hours;  // lit: when, where the value says so
};

/// Reads a value of `lit` or `light:lit` (OSM wiki, Key:lit): "yes", "24/7", "automatic",
/// "limited", "interval", "20:00-06:00", "Mo-Su 18:00-23:00", "sunset-sunrise", "no",
/// "disused", "unknown". Lamps that are lit for a part of the night are dark from 23:00 to
/// 5:00 (half-night switching).
LitTag read_lit_tag(std::string_view text);

}  // namespace nightcity::lights
