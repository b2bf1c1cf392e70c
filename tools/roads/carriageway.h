// The carriageway of a way: its class and its width from kerb to kerb, for all that stands beside it or
// drives on it.
#pragma once

#include <optional>

#include "tools/osm/osm_data.h"
#include "tools/roads/road_class.h"

namespace nightcity::roads {

struct Carriageway {
  const RoadClass* road_class = nullptr;
  double width_m = 0;         // from kerb to kerb
  bool width_tagged = false;  // by a width or a number of lanes
};

/// Returns class and width of a way with these tags; nothing for classes that are not in the table and for
/// crossings, which are a part of the road they cross.
std::optional<Carriageway> read_carriageway(const OsmTags& tags);

}  // namespace nightcity::roads
