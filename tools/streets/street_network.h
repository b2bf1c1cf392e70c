// The streets that are to be lit as a graph: stretches between junctions, each of one class and width. Ways
// are cut and joined for it, because mappers split them wherever a tag changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/roads/carriageway.h"

namespace nightcity::streets {

struct Street {
  /// Where on which way a piece of the line lies: lamps are named after it.
  struct Piece {
    std::int64_t way_id;
    double from_m, to_m;  // along the way from its first node
  };
  struct Place {
    glm::dvec2 point;
    glm::dvec2 along;  // unit
    std::int64_t way_id;
    double on_way_m;
  };

  roads::Carriageway road;
  std::string name;
  bool bridge = false;  // some of it
  std::vector<glm::dvec2> line;
  std::vector<double> at_m;            // of each point of the line, from its start
  std::vector<Piece> pieces;           // line.size() - 1
  std::size_t joints[2] = {~0u, ~0u};  // at start and end

  double length_m() const { return at_m.back(); }
  Place place(double s) const;
};

struct Joint {
  glm::dvec2 point{0, 0};
  struct End {
    std::size_t street;
    bool at_start;
  };
  std::vector<End> ends;  // three or more: a junction
};

struct StreetNetwork {
  std::vector<Street> streets;
  std::vector<Joint> joints;
};

/// Whether a way is to be lit: as its `lit` tag says, else by its class in a town. Empty = yes; otherwise why
/// not: "lit=no", "tunnel", "crossing or pavement beside a street", "unlit by class", ...
std::string why_unlit(const OsmWay& way);

/// Whether stretches that meet where nothing else does become one street.
enum class Joining {
  same_road,  // where class and width agree, whichever way they were drawn
  never       // a street is a part of one way, drawn as the way is
};

/// Ways meet where they share a node. `to_frame` as place_lamps takes it; points without a place are left
/// out.
StreetNetwork make_street_network(const std::vector<const OsmWay*>& ways,
                                  const std::function<glm::dvec2(const glm::dvec2&)>& to_frame,
                                  Joining joining = Joining::same_road);

}  // namespace nightcity::streets
