// Reads from the tags of a way what lies along its carriageway on one side.
#pragma once

#include <optional>

#include "tools/ground_cover/ground_kind.h"
#include "tools/osm/osm_data.h"
#include "tools/roads/parking_lane.h"
#include "tools/roads/road_class.h"

namespace nightcity::ground_cover {

/// The strips along one side of a carriageway, from the kerb outwards.
struct Roadside {
  double bay_m = 0, track_m = 0, pavement_m = 0;
  GroundKind track = GroundKind::asphalt, pavement = GroundKind::paving_stones;
  bool assumed = false;
  std::optional<roads::ParkingLane> parking{};
  double width_m() const { return bay_m + track_m + pavement_m; }
};

/// Returns the cycle track and the pavement of a side ("left", "right") with the widths and
/// surfaces that tags give them, or the pavement that is usual for the class of road.
Roadside read_roadside(const osm::OsmTags& tags, const roads::RoadClass& road, const char* side);

}  // namespace nightcity::ground_cover
