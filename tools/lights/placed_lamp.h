// A lamp in its place, and the light that it is.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "formats/light_file.h"
#include "tools/lights/night_schedule.h"

namespace nightcity::lights {

/// One luminaire on its post, in the frame's E, N, H metres.
struct PlacedLamp {
  glm::dvec3 foot{0};            // where the post meets the ground
  double mounting_height_m = 0;  // luminous centre above the foot
  glm::dvec2 outreach{0, 0};     // from the post to the luminous centre, horizontal, m
  glm::dvec2 aim{0, 1};          // unit, horizontal: towards the road (the C = 0 half-plane)
  bool hung = false;             // on a wire between facades, without a post
  double tilt_degrees = 0;       // of the luminaire's axis, from straight down towards `aim`
  double flux_lm = 0;
  double cct_k = 0;
  glm::vec3 colour{1};  // linear Rec. 709, luminance 1
  double radius_m = 0;  // luminous radius
  std::uint32_t profile = LIGHT_NO_PROFILE;
  std::optional<NightSchedule> hours;  // empty: always on
  // Class of the road that it lights, from the table of defaults; "": none.
  std::string_view highway;
  std::int64_t way_id = 0;  // that road, and how far along it the lamp stands
  double along_m = 0;
  std::uint32_t id = 0;
  LightProvenance provenance;
};

/// Returns the luminaire as a light in model space and adds its hours to `schedules`.
Light to_light(const PlacedLamp& lamp, const Georeference& georeference, ScheduleTable& schedules);

}  // namespace nightcity::lights
