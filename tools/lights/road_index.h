// Finds the road nearest to a lamp by a grid over short pieces of road, in constant time whatever
// the city's size.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tools/lights/lamp_defaults.h"
#include "tools/osm/osm_data.h"

namespace nightcity::lights {

class RoadIndex {
 public:
  struct Road {
    const RoadLighting* lighting;
    double width_m;  // carriageway
    std::int64_t way_id;
  };

  struct Nearest {
    const Road* road;
    glm::dvec2 point;   // on the centreline
    glm::dvec2 along;   // unit, the road's direction there
    double distance_m;  // to the centreline
    double along_m;     // distance of `point` from the way's first node, along the way
  };

  /// `to_frame` is that of place_lamps. Ways that have no lamps (proposed, ...) and points that
  /// have no place in the frame are left out.
  template <class ToFrame>
  RoadIndex(const std::vector<osm::OsmWay>& highways, const ToFrame& to_frame) {
    for (const osm::OsmWay& way : highways) {
      std::vector<glm::dvec2> line;
      for (const glm::dvec2& lon_lat : way.lon_lat) line.push_back(to_frame(lon_lat));
      add(way, line);
    }
  }

  /// Returns the road whose edge is nearest, if p lies within nearest_road_m of its centreline; of
  /// equally near ones the main road.
  /// Paths must be clearly nearer than streets; otherwise pavements mapped as ways of their own
  /// would get the street's lamps.
  std::optional<Nearest> nearest(const glm::dvec2& p) const;

 private:
  struct Piece {
    glm::dvec2 a, b;
    std::uint32_t road;
    double from_m;  // where a lies along the way
  };
  void add(const osm::OsmWay& way, const std::vector<glm::dvec2>& line);
  // Decides between pieces that are equally near: the main road, whatever the order of the file.
  bool comes_first(const Piece& a, const Piece& b) const;

  std::vector<Road> roads_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace nightcity::lights
