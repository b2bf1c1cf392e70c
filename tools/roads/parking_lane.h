// Reads from the tags of a street where cars park along it.
#pragma once

#include <optional>
#include <string>

#include "tools/osm/osm_data.h"

namespace nightcity::roads {

enum class ParkingPlace {
  lane,          // on the carriageway, of whose width it is a part
  street_side,   // in bays beside the carriageway and level with it
  half_on_kerb,  // half on the carriageway
  on_kerb        // on the pavement
};
enum class ParkingOrientation { parallel, diagonal, perpendicular };

/// The bay of a car.
struct ParkingBay {
  double depth_m;   // away from the carriageway's middle
  double length_m;  // along the street
  double lean_m;    // by which its far end lies further along than its near end

  /// Makes it less or more deep, with the same slant.
  void set_depth(double metres) {
    lean_m *= metres / depth_m;
    depth_m = metres;
  }
};

struct ParkingLane {
  ParkingPlace place = ParkingPlace::lane;
  ParkingOrientation orientation = ParkingOrientation::parallel;
  bool orientation_assumed = false;
  bool marked = false;              // the bays are painted
  std::optional<double> width_m{};  // as tagged
  std::string surface{};            // as tagged; empty where nothing says

  ParkingBay bay() const;
  /// Returns how much of it lies within the carriageway, m: all of a lane, half of one half on the
  /// kerb.
  double within_edge_m() const;
  /// Returns how much of it lies on what is beyond the carriageway's edge, m.
  double beyond_edge_m() const;
  /// Returns "lane, parallel".
  std::string name() const;
};

/// Returns the lane on one side of a street ("left", "right", seen along the way); none where no
/// tag says that cars park there, or where the lane is mapped as an area of its own. Reads
/// `parking:SIDE` and, where there is none, the older `parking:lane:SIDE`.
std::optional<ParkingLane> read_parking_lane(const osm::OsmTags& tags, const char* side);

/// Takes away all that tags say about parking along a street.
void drop_parking(osm::OsmTags& tags);

/// Returns whether a tag says that the lane on one side is mapped on its own, as an area.
bool is_parking_separate(const osm::OsmTags& tags, const char* side);

}  // namespace nightcity::roads
