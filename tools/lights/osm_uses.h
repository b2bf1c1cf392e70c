// Uses of buildings by the map, for buildings whose city model gives none.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tools/lights/building_use.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/osm_data.h"

namespace nightcity::lights {

/// Returns the use by building=*; if that is only "yes", by shop, office, amenity and tourism on
/// the same outline. Empty if none of them gives a use.
std::optional<BuildingUse> use_from_tags(const osm::OsmTags& tags);

/// Outlines of mapped buildings with a known use, found by place.
class OsmUses {
 public:
  /// `to_frame` is that of place_lamps. Outlines that are open, broken or wider than 2 km
  /// are left out. The holes of multipolygons belong to whatever stands in them.
  OsmUses(const std::vector<osm::OsmWay>& buildings, const std::vector<osm::MapArea>& multipolygons,
          const std::function<glm::dvec2(const glm::dvec2&)>& to_frame);

  /// Returns the use of the smallest outline around the place; empty if there is none.
  std::optional<BuildingUse> at(const glm::dvec2& place) const;

 private:
  struct Outline {
    std::vector<glm::dvec2> ring;
    std::vector<std::vector<glm::dvec2>> holes;
    double area_m2;
    BuildingUse use;
  };
  void add(Outline outline);

  std::vector<Outline> outlines_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace nightcity::lights
