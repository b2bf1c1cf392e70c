// Openings in barriers, through which people and vehicles pass: gates, and streets that meet them.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::barriers {

/// Widths of openings at the nodes of barriers. A node is known by its coordinates as written.
class Openings {
 public:
  /// Takes the gates of the map and those of its streets and paths that share a node with a
  /// barrier. An opening is as wide as the gate's tag `width` or `maxwidth` says, else as what
  /// passes it, else 0.90 m for people (DIN 18040-3) and 3.00 m for vehicles (RASt 06, drives).
  explicit Openings(const osm::OsmData& map);

  /// Returns the width of the opening at a node, m, where what passes does so at a right angle; 0
  /// where there is none.
  double width_at(const glm::dvec2& lon_lat) const;
  /// Returns how long the opening is along a barrier that leads that way in the frame (unit): what
  /// passes it aslant has room over its whole width and the barrier's thickness. Ways within 17
  /// degrees of the barrier count as if they passed it at these.
  double length_along(const glm::dvec2& lon_lat, const glm::dvec2& along, double thickness_m,
                      const place::LonLatToFrame& to_frame) const;

 private:
  struct Hash {
    std::size_t operator()(const glm::dvec2& p) const;
  };
  struct Passage {
    double width_m;
    glm::dvec2 towards;  // the next node of what passes, degrees
  };
  struct Opening {
    double gate_m = 0;
    bool is_said = false;  // the gate says how wide it is, whatever passes
    std::vector<Passage> passages;
  };

  std::unordered_map<glm::dvec2, Opening, Hash> openings_;
};

}  // namespace nightcity::barriers
