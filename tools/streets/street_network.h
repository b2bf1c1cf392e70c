// The street graph: stretches between junctions, each of one class and width. Ways are cut and
// joined for it, because mappers split them wherever a tag changes.
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
  /// The part of a way from which a piece of the line comes; the identities of lamps follow from
  /// it.
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

/// Decides whether two stretches become one street if nothing else meets them at their common end.
enum class Joining {
  same_road,  // if class and width agree, whatever their directions
  never       // a street is a part of one way and has its direction
};

/// Makes the graph of these ways. Ways meet where they share a node. Streets come in an order that
/// their places decide, whatever the order of the ways and their ids; those that may be joined lead
/// from their western end to the eastern one. `to_frame` is that of
/// place_lamps; points that it maps to no finite place are left out.
StreetNetwork make_street_network(const std::vector<const osm::OsmWay*>& ways,
                                  const std::function<glm::dvec2(const glm::dvec2&)>& to_frame,
                                  Joining joining = Joining::same_road);

}  // namespace nightcity::streets
