// The colours of a map's buildings.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::map_buildings {

/// The part of a building that a skin covers.
enum class Skin { walls, roof };

/// Returns the colour (sRGB in [0, 1]) that the tags say: `building:colour` or `roof:colour` as a
/// name or as #rrggbb, else the usual one of `building:material` or `roof:material`; none where
/// they say nothing that is known. Colours are as bright as paint is: white reflects 0.75 (Oke
/// 1987, table 8.2: white paint 0.50-0.90), and every other colour as much less as it is darker.
std::optional<glm::vec3> find_skin(const osm::OsmTags& tags, Skin skin);

/// Returns notes on the tags of colours and materials of parts for which `find_skin` finds nothing.
std::vector<std::string> find_unread_skins(const osm::OsmTags& tags);

}  // namespace nightcity::map_buildings
