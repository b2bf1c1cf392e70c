// The one table of what lights that are no street lamps are like where tags do not say. The sources
// are beside the rows in map_light_defaults.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "tools/lights/night_schedule.h"

namespace nightcity::map_lights {

enum class MapLightKind {
  advertising,     // posters, screens and signs that shine or are lit
  floodlit,        // buildings and monuments
  pitch,           // sports grounds
  petrol_station,  // the forecourt below the canopy
};
constexpr std::size_t map_light_kind_count = 4;

/// Returns the kind's name in recipes and reports.
const char* name_of(MapLightKind kind);
/// Returns the kind of that name.
std::optional<MapLightKind> find_kind(std::string_view name);

/// A kind of OSM's `advertising`.
struct SignDefaults {
  const char* advertising;
  double width_m, height_m;  // of a face; of a column its diameter and the height of its posters
  double foot_m;             // of the face above the ground
  int sides;                 // faces back to back; 0: a column, all round
  bool luminous;             // shines by itself unless a tag says otherwise
  double luminance_cd_m2;    // of one that shines by itself
};
/// Returns the row of a value of `advertising`; null for kinds that do not shine (flags, murals).
const SignDefaults* find_sign(std::string_view advertising);

/// Mean luminance of a poster that is lit from outside.
constexpr double lit_poster_cd_m2 = 60;
/// Colour temperature of signs.
constexpr double sign_cct_k = 5000;

/// Maintained mean illuminance of a pitch for a value of OSM's `sport`; of others, that of
/// football.
double find_pitch_lx(std::string_view sport);
constexpr double pitch_cct_k = 4000;

/// Maintained mean illuminance of a floodlit wall, on the wall.
constexpr double facade_lx = 80;
constexpr double facade_cct_k = 3000;

/// Maintained mean illuminance on the ground below a canopy, and of a forecourt without one.
constexpr double canopy_lx = 150, forecourt_lx = 50;
constexpr double canopy_cct_k = 4000;

/// Returns when lights of a kind are dark where no tag says so; an empty span: never.
lights::NightSpan find_dark_span(MapLightKind kind);

}  // namespace nightcity::map_lights
