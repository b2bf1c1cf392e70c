// The carriageway of a way: its class, its lanes and its width from kerb to kerb. Everything that
// stands beside a road or drives on it takes the kerb from here.
#pragma once

#include <optional>

#include "tools/osm/osm_data.h"
#include "tools/roads/road_class.h"

namespace nightcity::roads {

/// Lanes narrower than this are not driven on: a car is 1.8 m wide and has mirrors.
constexpr double min_lane_m = 2.2;
/// Vehicles keep to lanes of this width where a carriageway offers more: the rest is for parked
/// cars.
constexpr double max_lane_m = 4.5;

struct Carriageway {
  const RoadClass* road_class = nullptr;
  int lanes[2] = {0, 0};  // along the way as it is drawn, and against it; both 0 on paths
  double width_m = 0;     // from kerb to kerb
  /// The part of the width that cars park on, to the left and to the right of the way as drawn.
  double parked_m[2] = {0, 0};
  bool is_widened = false;  // for parked cars, because no tag gives the width
  bool roundabout = false;

  /// Width in metres of each lane that vehicles drive on; 0 on paths. The lanes lie side by side
  /// around lanes_left_m(), and never reach beyond the kerbs or where cars park.
  double lane_m() const;
  /// Returns how far the middle of the lanes lies to the left of the carriageway's own, m.
  double lanes_left_m() const { return (parked_m[1] - parked_m[0]) / 2; }
  bool operator==(const Carriageway&) const = default;
};

/// Returns the carriageway of a way with these tags. The width is, in this order: the tag
/// `width`; the number of lanes (tagged, else the class's) times the class's lane width, and its
/// shoulders; the width of a single lane. Where cars park on the carriageway (ParkingLane), the
/// tag counts them in, and the others do not (OSM wiki, "Key:width", "Key:lanes"). It is never less
/// than min_lane_m for each lane that is driven on: cars park on the rest at most. Empty for classes
/// that are not in the table and for crossings, which are a part of the road they cross.
std::optional<Carriageway> read_carriageway(const osm::OsmTags& tags);

/// Returns the width in metres from kerb to kerb; 0 where read_carriageway is empty.
double carriageway_width(const osm::OsmTags& tags);

}  // namespace nightcity::roads
