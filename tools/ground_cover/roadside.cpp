#include "tools/ground_cover/roadside.h"

#include <string>

#include "tools/ground_cover/street_areas.h"
#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// Returns the value of a tag for one side: KEY:right, KEY:both, or KEY where it names the side.
std::string value_at_side(const osm::OsmTags& tags, const std::string& key, const char* side) {
  for (const std::string& name : {key + ":" + side, key + ":both"})
    if (std::string value = osm::find_tag(tags, name); !value.empty()) return value;
  const std::string value = osm::find_tag(tags, key);
  if (value == "left" || value == "right") return value == side ? "yes" : "no";
  return value == "both" || value == "ambos" || value == "ambas" || value == "left;right" ||
                 value == "right;left"
             ? "yes"
             : value;
}

// Returns KEY:right SUFFIX, KEY:both SUFFIX or KEY SUFFIX, as written.
std::string text_at_side(const osm::OsmTags& tags, const std::string& key, const char* side,
                         const std::string& suffix) {
  for (const std::string& name : {key + ":" + side, key + ":both", key})
    if (const auto found = tags.find(name + suffix); found != tags.end()) return found->second;
  return {};
}

// Width and surface of a strip beside the carriageway where tags give them.
void read_strip(const osm::OsmTags& tags, const std::string& key, const char* side, double& width_m,
                GroundKind& kind) {
  const auto width = osm::parse_length_m(text_at_side(tags, key, side, ":width"));
  if (width && *width >= 0.5 && *width <= 20) width_m = *width;
  kind = find_surface(text_at_side(tags, key, side, ":surface")).value_or(kind);
}

bool has_cycle_track(const osm::OsmTags& tags, const char* side) {
  const std::string value = value_at_side(tags, "cycleway", side);
  // "opposite_track" names no side, unless its key does.
  return value == "track" ||
         (value == "opposite_track" && osm::find_tag(tags, "cycleway") != "opposite_track");
}

}  // namespace

Roadside read_roadside(const osm::OsmTags& tags, const roads::RoadClass& road, const char* side) {
  Roadside result;
  if (has_cycle_track(tags, side)) {
    result.track_m = cycle_track_m;
    read_strip(tags, "cycleway", side, result.track_m, result.track);
  }
  const std::string pavement = value_at_side(tags, "sidewalk", side);
  if (pavement == "yes") {
    result.pavement_m = road.pavement_m > 0 ? road.pavement_m : roads::pavement_m;
    read_strip(tags, "sidewalk", side, result.pavement_m, result.pavement);
  } else if (pavement.empty()) {
    result.pavement_m = road.pavement_m;
    result.assumed = road.pavement_m > 0;
  }
  return result;
}

}  // namespace nightcity::ground_cover
