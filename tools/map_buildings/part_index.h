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

}  // namespace nightcity::map_buildings
