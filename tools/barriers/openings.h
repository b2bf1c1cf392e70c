// Openings in barriers, through which people and vehicles pass: gates, and streets that meet them.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::barriers {

/// Widths of openings at the nodes of barriers. A node is known by its coordinates as written.
class Openings {
 public:
  /// Takes the gates of the map and those of its streets and paths that share a node with a
  /// barrier. An opening is as wide as the gate's tag `width` or `maxwidth` says, else as what
  /// passes it, else 0.90 m for people (DIN 18040-3) and 3.00 m for vehicles (RASt 06, drives).
  explicit Openings(const osm::OsmData& map);

  /// Returns the width of the opening at a node, m; 0 where there is none.
  double width_at(const glm::dvec2& lon_lat) const;

 private:
  struct Hash {
    std::size_t operator()(const glm::dvec2& p) const;
  };
  void widen(const glm::dvec2& lon_lat, double width_m);

  std::unordered_map<glm::dvec2, double, Hash> widths_;
};

}  // namespace nightcity::barriers
