// Elements of a map as parsers deliver them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// The state of an element in a file. The one with the greatest version counts, and an edited one
/// counts before the version that it was made from; 0 if the file has no versions.
struct OsmVersion {
  std::uint32_t number = 0;
  bool edited = false;   // by an editor, and not uploaded yet
  bool deleted = false;  // the element is gone: it takes older versions along

  /// Returns a number that is greater for a newer version.
  std::uint32_t rank() const {
    return 2 * std::min(number, std::uint32_t{1} << 30) + (edited ? 1 : 0);
  }
};

/// A node of a way. `lon_lat` is not a number unless the way holds its nodes' places itself
/// (`osmium add-locations-to-ways`, Overpass' `out geom`).
struct OsmNodeRef {
  std::int64_t id;
  glm::dvec2 lon_lat{std::numeric_limits<double>::quiet_NaN()};
};

struct OsmMember {
  enum class Type : std::uint8_t { node, way, relation };
  Type type = Type::node;
  std::int64_t id = 0;
  std::string role;
  std::vector<glm::dvec2> places;  // where the relation says them (Overpass' `out geom`)
};

struct OsmRelation {
  OsmTags tags;
  std::vector<OsmMember> members;    // of a lamp
  std::optional<glm::dvec2> centre;  // where Overpass gives it alone (`out center`)
};

}  // namespace nightcity::osm
