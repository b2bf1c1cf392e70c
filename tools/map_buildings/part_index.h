// Finds the building that a part of one lies in.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tools/osm/map_areas.h"

namespace nightcity::map_buildings {

class PartIndex {
 public:
  /// Keeps a reference to `buildings`.
  explicit PartIndex(const std::vector<osm::MapArea>& buildings);

  /// Returns the number of the building with the smallest box that holds a place inside the part.
  std::optional<std::size_t> find_building(const osm::MapArea& part) const;

 private:
  const std::vector<osm::MapArea>& buildings_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> cells_;
};

/// Returns a place inside an area: the mean of the vertices of its first ring or, where that lies
/// outside, the middle of two of them that lies inside.
glm::dvec2 find_place_inside(const osm::MapArea& area);

}  // namespace nightcity::map_buildings
