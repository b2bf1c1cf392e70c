// The road nearest to a lamp, by a grid over short pieces of road: constant time a lamp, whatever the city's
// size.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tools/lights/lamp_defaults.h"
#include "tools/osm/osm_data.h"

namespace nightcity {

class RoadIndex {
 public:
  struct Road {
    const RoadLighting* lighting;
    double width_m;  // carriageway
    std::int64_t way_id;
  };

  struct Nearest {
    const Road* road;
    glm::dvec2 point;   // on the middle line
    glm::dvec2 along;   // unit, the road's direction there
    double distance_m;  // to the middle line
    double along_m;     // of `point`, from the way's first node
  };

  /// `to_frame` as place_lamps takes it. Ways that carry no lamps (proposed, ...) and points with no place
  /// are left out.
  template <class ToFrame>
  RoadIndex(const std::vector<OsmWay>& highways, const ToFrame& to_frame) {
    for (const OsmWay& way : highways) {
      std::vector<glm::dvec2> line;
      for (const glm::dvec2& lon_lat : way.lon_lat) line.push_back(to_frame(lon_lat));
      add(way, line);
    }
  }

  /// The road whose edge is nearest, within nearest_road_m of its middle line. Paths have to be clearly
  /// nearer than a street: pavements mapped as ways of their own would otherwise claim the street's lamps.
  std::optional<Nearest> nearest(const glm::dvec2& p) const;

 private:
  struct Piece {
    glm::dvec2 a, b;
    std::uint32_t road;
    double from_m;  // of a, along the way
  };
  void add(const OsmWay& way, const std::vector<glm::dvec2>& line);

  std::vector<Road> roads_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace nightcity
