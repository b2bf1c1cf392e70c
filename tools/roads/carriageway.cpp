#include "tools/roads/carriageway.h"

#include <cstdlib>
#include <string>

#include "tools/osm/tag_values.h"

namespace nightcity::roads {

std::optional<Carriageway> read_carriageway(const OsmTags& tags) {
  const auto tag = [&](const char* key) {
    const auto found = tags.find(key);
    return found == tags.end() ? std::string() : found->second;
  };
  const RoadClass* road_class = find_road_class(normalise_tag(tag("highway")));
  if (!road_class || normalise_tag(tag("footway")) == "crossing") return std::nullopt;
  Carriageway carriageway{road_class, road_class->width_m, false};
  const auto width = parse_length_m(tag("width"));
  const std::string lanes_text = tag("lanes");
  const int lanes = std::atoi(lanes_text.c_str());
  if (width && *width >= 1 && *width <= 60) {
    carriageway.width_m = *width;
    carriageway.width_tagged = true;
  } else if (lanes >= 1 && lanes <= 12) {
    carriageway.width_m = lanes * (road_class->tier == RoadTier::main ? 3.5 : 3.0);
    carriageway.width_tagged = true;
  }
  return carriageway;
}

}  // namespace nightcity::roads
