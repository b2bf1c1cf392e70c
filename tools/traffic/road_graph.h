// The streets as a driver sees them: directed edges with lanes between nodes, cut off where
// the ground ends.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/traffic/drivable.h"

namespace nightcity::traffic {

constexpr std::size_t none = ~std::size_t{0};

/// One direction of one street.
struct RoadEdge {
  std::size_t from = none, to = none;  // nodes
  std::size_t opposite = none;         // the other direction of the same street
  std::vector<glm::dvec2> line;        // centreline of the street in driving direction; E, N, m
  double length_m = 0;
  const roads::RoadClass* road = nullptr;
  const TrafficClass* traffic = nullptr;
  int lanes = 1;
  double lane_m = 3;  // width of a lane
  // Half the width of all lanes, both directions together: vehicles keep within it, around
  // middle_m, and no lane reaches beyond the carriageway.
  double half_width_m = 3;
  // By which the middle of all lanes lies to the right of the line: not 0 where cars park on one
  // side alone.
  double middle_m = 0;
  double speed_m_s = 0;  // limit
  bool one_way = false, roundabout = false;
  bool structure = false;  // bridge or tunnel: not on the ground
  bool bridge = false;
  std::int64_t way_id = 0;
  std::string name;

  /// Returns how far the middle of a lane lies to the right of the centreline, in metres. Lane 0 is
  /// at the kerb of the side driven on.
  double lane_offset(int lane, Side side) const;
};

/// Return the unit vectors along the first and the last piece of an edge's line.
glm::dvec2 find_start_direction(const RoadEdge& edge);
glm::dvec2 find_end_direction(const RoadEdge& edge);

struct RoadNode {
  glm::dvec2 place{0, 0};
  double height_m = 0;
  std::vector<std::size_t> in, out;  // edges
  bool border = false;               // the map ends here, but the street does not
  /// Number of streets that meet here; fewer than three make no junction.
  int streets = 0;
};

struct RoadGraph {
  Side side = Side::right;
  std::string country;
  std::vector<RoadNode> nodes;
  std::vector<RoadEdge> edges;
  std::map<std::string, std::size_t> left_out;  // ways, by reason

  double lane_km() const;
};

/// Makes the graph of all drivable ways. Streets end where the model has no ground (`height_at` is
/// empty there). Streets at ground level that run through a building (`inside`) are left out.
/// `side` overrides the side on which the country drives.
RoadGraph make_road_graph(const std::vector<osm::OsmWay>& highways,
                          const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
                          const place::InsideBuilding& inside,
                          std::optional<Side> side = std::nullopt);

}  // namespace nightcity::traffic
