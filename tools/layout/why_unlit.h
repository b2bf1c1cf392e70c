// Decides which ways of a map get no lamps.
#pragma once

#include <string>

#include "tools/lights/lit_tag.h"
#include "tools/osm/osm_data.h"

namespace nightcity::layout {

/// Returns why a way is not to be lit: "lit=no", "tunnel or under cover", "crossing or pavement
/// beside a street", "unlit by class", ...; empty if it is to be lit. `lit`, which its tags say,
/// decides, otherwise the class of road in a town.
std::string why_unlit(const osm::OsmWay& way, lights::LitTag::Kind lit);

}  // namespace nightcity::layout
