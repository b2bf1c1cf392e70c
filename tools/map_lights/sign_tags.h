// The tags of advertising: how large its faces are, and whether and how they shine.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "formats/light_file.h"
#include "tools/lights/night_schedule.h"
#include "tools/map_lights/map_light_defaults.h"
#include "tools/osm/osm_data.h"

namespace nightcity::map_lights {

struct SignTags {
  const SignDefaults* kind = nullptr;
  double width_m = 0, height_m = 0, foot_m = 0;  // of a face; of a column as SignDefaults'
  int sides = 1;
  double luminance_cd_m2 = 0;
  bool luminous = false;                  // shines by itself, rather than being lit from outside
  std::optional<double> bearing_degrees;  // that it faces, clockwise from north
  ValueSource size = ValueSource::rule, shines = ValueSource::rule;
  std::optional<lights::NightSchedule> hours;  // where a tag says so
  std::string dark;                            // why it gives no light, for the report; "": it does
  std::map<std::string, std::size_t> unread;   // values not understood, or out of bounds
};

/// Reads `size` ("3.56 x 2.52"), `width`, `height` (of the top above the ground), `min_height`,
/// `sides`, `direction`, `luminous`, `lit`. Never throws. `kind` must be that of the tags;
/// `half` is where it stands (lit_hours.h).
SignTags read_sign_tags(const osm::OsmTags& tags, const SignDefaults& kind,
                        lights::Half half = lights::Half::north);

}  // namespace nightcity::map_lights
